#include "welkin/map_file/view_chains_file.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/map_file/chain_attributes.h"
#include "welkin/map_file/map_file_job.h"

namespace welkin {

namespace fs = std::filesystem;
using namespace map_file;

namespace {

// Text metadata; those of a stack begin with welkin.view-, those of sums with welkin.lobes-.
constexpr const char* kViewBrdf = "welkin.view-brdf";
constexpr const char* kViewAxis = "welkin.view-axis";
constexpr const char* kViewCosines = "welkin.view-cosines";
constexpr const char* kViewLift = "welkin.view-lift";
constexpr const char* kViewAlbedo = "welkin.view-albedo";
constexpr const char* kLobesBrdf = "welkin.lobes-brdf";
constexpr const char* kLobesCosines = "welkin.lobes-cosines";
constexpr const char* kLobesRoughness = "welkin.lobes-roughness";
constexpr const char* kLobesWeight = "welkin.lobes-weight";
constexpr const char* kLobesLevel = "welkin.lobes-level";
constexpr const char* kLobesLift = "welkin.lobes-lift";
constexpr const char* kLobesAlbedo = "welkin.lobes-albedo";

/// More numbers than any table of ours has.
constexpr std::size_t kMostNumbers = 1 << 20;

using Attributes = std::map<std::string, std::string>;

std::string list_of(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ",") + number_text(number);
  return text;
}

/// The numbers of an attribute; Error (damaged) unless it is a list of them.
std::vector<double> numbers_of(const std::string& file, const Attributes& attributes, const char* key) {
  const auto found = attributes.find(key);
  std::vector<double> numbers;
  std::string_view text = found == attributes.end() ? std::string_view{} : found->second;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::optional<double> number = parse_number(text.substr(0, comma));
    if (!number || numbers.size() == kMostNumbers)
      throw Error(ErrorKind::damaged, file, std::string("its metadata ") + key + " is not a list of numbers");
    numbers.push_back(*number);
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  if (numbers.empty()) throw Error(ErrorKind::damaged, file, std::string("lacks its metadata ") + key);
  return numbers;
}

std::string text_in(const Attributes& attributes, const char* key) {
  const auto found = attributes.find(key);
  return found == attributes.end() ? std::string() : found->second;
}

/// What is wrong with notes that were read is wrong with the file.
template <class Stack>
void check_read(const fs::path& path, const Stack& stack) {
  try {
    stack.check();
  } catch (const Error& error) {
    throw Error(ErrorKind::damaged, path.string(), error.what());
  }
}

}  // namespace

io::WriteReport write_view_chains(const fs::path& path, const ViewChains& stack,
                                  const WriteMapOptions& options) {
  stack.check();
  const Destination destination(path);
  const Chain& first = stack.views.front();
  const int levels = static_cast<int>(first.levels.size());
  if (!destination.format.pictures && !destination.format.texture)
    throw Error(ErrorKind::unsupported, path.string(),
                "holds one picture, not one for each angle of view: write KTX2, or EXR of one level");
  if (levels > 1 && !destination.format.texture)
    throw Error(ErrorKind::unsupported, path.string(),
                "an " + destination.format.title + " of several angles of view holds one level, not " +
                    std::to_string(levels) + ": write KTX2");
  const Map& finest = first.levels.front();
  const Layout layout = default_layout(finest.parameterization, destination.format, levels);
  std::vector<WrittenLevel> maps;
  for (const Chain& chain : stack.views) {
    check_chain_members(chain);
    maps.insert(maps.end(), chain.levels.begin(), chain.levels.end());
  }
  check_levels(destination, {finest.parameterization, layout}, {finest.width(), finest.height()}, levels,
               options);
  WriteMapOptions with_notes = options;
  Attributes& notes = with_notes.image.attributes;
  for (const auto& [key, text] : attributes_of(first.notes)) notes[key] = text;
  notes[kViewBrdf] = stack.notes.brdf;
  notes[kViewAxis] = stack.notes.axis;
  notes[kViewCosines] = list_of(stack.notes.view_cosines);
  notes[kViewLift] = list_of(stack.notes.lift.values);
  notes[kViewAlbedo] = list_of(stack.notes.albedo.values);
  return write_levels(destination, maps, layout, with_notes, static_cast<int>(stack.views.size()));
}

ViewChains read_view_chains(const fs::path& path, const ReadMapOptions& options) {
  ReadMapOptions of_view = options;
  of_view.part = 0;
  MapReader reader(path, of_view);
  const Attributes attributes = reader.info().image.attributes;
  if (attributes.find(kViewCosines) == attributes.end())
    throw Error(ErrorKind::unsupported, path.string(),
                "is not a stack of angles of view: it lacks the metadata " + std::string(kViewCosines));
  ViewChains stack;
  const std::string file = path.string();
  const int levels = std::max<int>(1, static_cast<int>(reader.info().levels.size()));
  stack.notes = {text_in(attributes, kViewBrdf),
                 text_in(attributes, kViewAxis),
                 numbers_of(file, attributes, kViewCosines),
                 {levels, numbers_of(file, attributes, kViewLift)},
                 {levels, numbers_of(file, attributes, kViewAlbedo)}};
  for (std::size_t view = 0; view < stack.notes.view_cosines.size(); ++view) {
    reader.set_part(view);
    stack.views.push_back(read_chain(reader));
  }
  check_read(path, stack);
  return stack;
}

io::WriteReport write_lobe_sums(const fs::path& path, const LobeSumChain& chain,
                                const WriteMapOptions& options) {
  chain.check();
  std::vector<double> weights, levels, lifts;
  for (const LobeLookUp& each : chain.sums.look_ups) {
    weights.push_back(each.weight);
    levels.push_back(each.level);
    lifts.push_back(each.lift);
  }
  WriteMapOptions with_notes = options;
  Attributes& notes = with_notes.image.attributes;
  notes[kLobesBrdf] = chain.sums.brdf;
  notes[kLobesCosines] = list_of(chain.sums.view_cosines);
  notes[kLobesRoughness] = list_of(chain.sums.roughness);
  notes[kLobesWeight] = list_of(weights);
  notes[kLobesLevel] = list_of(levels);
  notes[kLobesLift] = list_of(lifts);
  notes[kLobesAlbedo] = list_of(chain.sums.albedo.values);
  return write_chain(path, chain.chain, with_notes);
}

LobeSumChain read_lobe_sums(const fs::path& path, const ReadMapOptions& options) {
  MapReader reader(path, options);
  const Attributes attributes = reader.info().image.attributes;
  if (attributes.find(kLobesCosines) == attributes.end())
    throw Error(ErrorKind::unsupported, path.string(),
                "has no tables of lobes to add: it lacks the metadata " + std::string(kLobesCosines));
  const std::string file = path.string();
  LobeSumChain read;
  LobeSums& sums = read.sums;
  sums.brdf = text_in(attributes, kLobesBrdf);
  sums.view_cosines = numbers_of(file, attributes, kLobesCosines);
  sums.roughness = numbers_of(file, attributes, kLobesRoughness);
  const std::vector<double> weights = numbers_of(file, attributes, kLobesWeight),
                            levels = numbers_of(file, attributes, kLobesLevel),
                            lifts = numbers_of(file, attributes, kLobesLift);
  const std::size_t pairs = sums.view_cosines.size() * sums.roughness.size();
  if (levels.size() != weights.size() || lifts.size() != weights.size() || weights.size() % pairs != 0)
    throw Error(ErrorKind::damaged, file, "its tables of lobes differ in size");
  sums.count = static_cast<int>(weights.size() / pairs);
  for (std::size_t i = 0; i < weights.size(); ++i) sums.look_ups.push_back({weights[i], levels[i], lifts[i]});
  sums.albedo = {static_cast<int>(sums.roughness.size()), numbers_of(file, attributes, kLobesAlbedo)};
  read.chain = read_chain(reader);
  check_read(path, read);
  return read;
}

}  // namespace welkin
