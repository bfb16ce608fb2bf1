#include "welkin/map_file/chain_attributes.h"

#include <algorithm>
#include <string_view>

#include "welkin/base/number_text.h"

namespace welkin {
namespace {

constexpr const char* kLobeKey = "welkin.lobe";
constexpr const char* kRoughnessKey = "welkin.roughness";
constexpr const char* kCurveKey = "welkin.roughness-curve";
constexpr const char* kNormalisationKey = "welkin.normalisation";
constexpr const char* kSoftwareKey = "welkin.software";

/// Of a side of 2^20 texels, the largest there is.
constexpr std::size_t kMaxLevels = 21;

std::string list_of(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ",") + number_text(number);
  return text;
}

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::optional<double> number = parse_number(text.substr(0, comma));
    if (!number || *number < 0 || numbers.size() == kMaxLevels) return {};
    numbers.push_back(*number);
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return numbers;
}

}  // namespace

std::map<std::string, std::string> attributes_of(const ChainNotes& notes) {
  std::map<std::string, std::string> attributes;
  const auto note = [&](const char* key, const std::string& text) {
    if (!text.empty()) attributes[key] = text;
  };
  note(kLobeKey, notes.lobe);
  note(kRoughnessKey, list_of(notes.roughness));
  note(kCurveKey, notes.curve);
  note(kNormalisationKey, notes.normalisation);
  note(kSoftwareKey, notes.software);
  return attributes;
}

ChainNotes chain_notes_from(const std::map<std::string, std::string>& attributes) {
  const auto noted = [&](const char* key) {
    const auto found = attributes.find(key);
    return found == attributes.end() ? std::string() : found->second;
  };
  return {noted(kLobeKey), numbers_in(noted(kRoughnessKey)), noted(kCurveKey), noted(kNormalisationKey),
          noted(kSoftwareKey)};
}

}  // namespace welkin
