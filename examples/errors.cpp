// Every kind of error, caught and told apart.
#include <unistd.h>
#include <welkin/welkin.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

namespace {

using welkin::Error, welkin::ErrorKind;

int failures = 0;

/// Runs what must fail, and prints how.
void expect(ErrorKind kind, const std::function<void()>& work) {
  const std::string wanted(name_of(kind));
  try {
    work();
    std::printf("%-12s nothing was thrown\n", wanted.c_str());
  } catch (const Error& error) {
    if (error.kind() == kind) {
      std::printf("%-12s %s\n", wanted.c_str(), error.what());
      return;
    }
    std::printf("%-12s but it is '%s': %s\n", wanted.c_str(), std::string(name_of(error.kind())).c_str(),
                error.what());
  }
  ++failures;
}

void write_text(const char* path, const char* text) {
  std::ofstream(path) << text;
}

}  // namespace

int main() try {
  const auto latlong = welkin::sphere::AnyParameterization::make("latlong");
  welkin::Map map(latlong, 8, 4, 3);

  expect(ErrorKind::not_found, [] { welkin::read_map("missing.exr"); });
  expect(ErrorKind::denied, [&] {
    std::filesystem::create_directory("closed");
    std::filesystem::permissions("closed", std::filesystem::perms::owner_read);
    const bool root = ::geteuid() == 0;  // who may write anywhere
    if (root && ::seteuid(65534) != 0) return;
    try {
      welkin::write_map("closed/map.exr", map);
    } catch (...) {
      if (root && ::seteuid(0) != 0) std::abort();
      throw;
    }
  });
  expect(ErrorKind::system, [&] { welkin::write_map(std::string(300, 'x') + ".exr", map); });
  write_text("short.pfm", "PF\n64 32\n-1.0\n");
  expect(ErrorKind::damaged, [] { welkin::read_map("short.pfm"); });
  write_text("notes.txt", "no picture at all");
  expect(ErrorKind::unsupported, [] { welkin::read_map("notes.txt"); });
  expect(ErrorKind::mismatch, [&] {
    const welkin::BakePlan plan({latlong, {16, 8}, 3});
    plan.run(map);
  });
  expect(ErrorKind::too_large, [&] {
    welkin::ReadMapOptions options;
    options.image.max_bytes = 100;
    welkin::write_map("small.exr", map);
    welkin::read_map("small.exr", options);
  });
  expect(ErrorKind::bad_value, [&] {
    welkin::Map sick(latlong, 8, 4, 3);
    sick.level.chart(0).at(3, 2)[0] = std::numeric_limits<float>::quiet_NaN();
    welkin::bake(sick);
  });
  expect(ErrorKind::bad_request, [] { welkin::sphere::AnyParameterization::make("octahedrl"); });

  // The file that an error is about, and the cause alone.
  try {
    welkin::read_map("missing.exr");
  } catch (const Error& error) {
    std::printf("file '%s', cause '%s'\n", error.file().c_str(), error.cause().c_str());
  }
  return failures;
} catch (const std::exception& error) {
  std::fprintf(stderr, "errors: %s\n", error.what());
  return 1;
}
