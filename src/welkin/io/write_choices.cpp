#include "welkin/io/write_choices.h"

#include <algorithm>

#include "welkin/base/error.h"
#include "welkin/base/listed.h"

namespace welkin::io {

const WritePart& only_part(std::span<const WritePart> parts, std::string_view format) {
  if (parts.size() == 1) return parts.front();
  throw Error(ErrorKind::unsupported,
              std::string(format) + " holds one picture, not " + std::to_string(parts.size()));
}

void check_sides(const WritePart& part, int largest, std::string_view format) {
  if (part.image.width <= largest && part.image.height <= largest) return;
  throw Error(ErrorKind::bad_request, std::to_string(part.image.width) + "×" +
                                          std::to_string(part.image.height) + " is too large for " +
                                          std::string(format) + ", whose sides are at most " +
                                          std::to_string(largest));
}

std::vector<int> channel_order(const WritePart& part, Alpha alpha, std::string_view format) {
  if (part.channels.size() == 1) return {0};
  using Names = std::vector<std::string>;
  std::vector<Names> known = {{"R", "G", "B"}};
  if (alpha == Alpha::allowed) known.insert(known.end(), {Names{"Y", "A"}, Names{"R", "G", "B", "A"}});
  for (const Names& names : known) {
    if (!std::is_permutation(names.begin(), names.end(), part.channels.begin(), part.channels.end()))
      continue;
    std::vector<int> order;
    for (const auto& name : names) {
      const auto found = std::find(part.channels.begin(), part.channels.end(), name);
      order.push_back(static_cast<int>(found - part.channels.begin()));
    }
    return order;
  }
  const std::string asked = listed(part.channels);
  throw Error(ErrorKind::unsupported, std::string(format) + " holds the channels Y or R G B" +
                                          (alpha == Alpha::allowed ? ", either with A" : " without alpha") +
                                          "; not " + asked);
}

bool is_red_green(const WritePart& part) {
  const std::vector<std::string> names{"R", "G"};
  return std::is_permutation(names.begin(), names.end(), part.channels.begin(), part.channels.end());
}

std::vector<int> red_green_order(const WritePart& part) {
  return part.channels.front() == "R" ? std::vector{0, 1} : std::vector{1, 0};
}

PixelType pixel_type(const WriteOptions& options, std::span<const PixelType> known, std::string_view format) {
  if (!options.type) return known.front();
  if (std::find(known.begin(), known.end(), *options.type) != known.end()) return *options.type;
  std::string names;
  for (const PixelType type : known) names += (names.empty() ? "" : ", ") + std::string(name_of(type));
  throw Error(ErrorKind::unsupported, std::string(format) + " holds no " +
                                          std::string(name_of(*options.type)) + " pixels (one of: " + names +
                                          ")");
}

std::string compression(const WriteOptions& options, std::span<const std::string> known,
                        std::string_view format) {
  if (options.compression.empty()) return known.front();
  if (std::find(known.begin(), known.end(), options.compression) != known.end()) return options.compression;
  throw Error(ErrorKind::bad_request,
              unknown_name(std::string(format) + " compression", options.compression, known));
}

int checked_quality(const WriteOptions& options) {
  if (options.quality >= 1 && options.quality <= 100) return options.quality;
  throw Error(ErrorKind::bad_request, "the quality " + std::to_string(options.quality) + " is not in 1…100");
}

Colour colour_for(PixelType type, Colour asked) {
  if (asked != Colour::automatic) return asked;
  return type == PixelType::uint8 || type == PixelType::uint16 ? Colour::srgb : Colour::linear;
}

}  // namespace welkin::io
