#include "welkin/synth/synth.h"

#include "welkin/base/error.h"
#include "welkin/synth/maps.h"

namespace welkin::synth {
namespace {

struct Entry {
  const char* name;
  const char* description;
  Radiance (*make)(const SynthOptions&);
};

constexpr Entry kMaps[] = {
    {"axes", "test card: named and coloured axes, degree grid, targets on the corners of the cube",
     make_axes},
    {"studio", "photographic studio: three soft boxes, a strip light and two rim lights in a grey cove",
     make_studio},
    {"sky", "clear sky with its sun, over a plain (Preetham, Shirley & Smits 1999)", make_sky},
    {"room", "room with coloured walls, a lamp panel and a window, lit exactly", make_room},
    {"sun", "one uniform disc in an even sky, of known energy", make_sun},
    {"lamps", "thousands of small lamps whose radiance spans a factor of 3000", make_lamps},
    {"checker", "longitude-latitude checker", make_checker},
    {"lines", "thin meridians and parallels of even width", make_lines},
    {"zoneplate", "rings around +Z, finer and finer toward -Z", make_zoneplate},
    {"constant", "the same radiance everywhere: the furnace test", make_constant},
};

const Entry& find(std::string_view name) {
  for (const Entry& entry : kMaps) {
    if (entry.name == name) return entry;
  }
  throw Error(ErrorKind::bad_request, unknown_name("built-in map", name, names()));
}

}  // namespace

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Entry& entry : kMaps) all.emplace_back(entry.name);
  return all;
}

std::string description(std::string_view name) {
  return find(name).description;
}

Radiance make(std::string_view name, const SynthOptions& options) {
  return find(name).make(options);
}

}  // namespace welkin::synth
