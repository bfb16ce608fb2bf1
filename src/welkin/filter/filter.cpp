#include "welkin/filter/filter.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "welkin/base/error.h"

namespace welkin {
namespace {

constexpr std::array<std::pair<std::string_view, Filter>, 5> kFilterNames{{{"auto", Filter::automatic},
                                                                           {"nearest", Filter::nearest},
                                                                           {"bilinear", Filter::bilinear},
                                                                           {"bicubic", Filter::bicubic},
                                                                           {"lanczos", Filter::lanczos}}};

}  // namespace

Filter filter_from_name(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& [each, filter] : kFilterNames) {
    if (each == name) return filter;
    names.emplace_back(each);
  }
  throw Error(ErrorKind::bad_request, unknown_name("filter", name, names));
}

std::string_view name_of(Filter filter) {
  for (const auto& [name, each] : kFilterNames) {
    if (each == filter) return name;
  }
  return "?";
}

}  // namespace welkin
