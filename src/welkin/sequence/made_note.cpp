#include "welkin/sequence/made_note.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <system_error>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/listed.h"
#include "welkin/base/number_text.h"
#include "welkin/base/version.h"
#include "welkin/io/image_file.h"
#include "welkin/map_file/face_names.h"
#include "welkin/map_file/map_file_job.h"

namespace welkin::sequence {
namespace {

namespace fs = std::filesystem;

/// Fowler, Noll and Vo's hash FNV-1a of 64 bits, over texts that are kept apart.
class Digest {
 public:
  Digest& add(std::string_view text) {
    for (const char c : text) step(static_cast<unsigned char>(c));
    step(0);
    return *this;
  }
  Digest& add(double number) { return add(number_text(number)); }
  Digest& add(const Matrix3& matrix) {
    for (const auto& row : matrix.rows) {
      for (const double value : row) add(value);
    }
    return *this;
  }
  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(state_));
    return digits;
  }

 private:
  void step(unsigned char byte) { state_ = (state_ ^ byte) * 0x100000001b3u; }

  std::uint64_t state_ = 0xcbf29ce484222325u;
};

/// A lobe from a table has a name and no numbers.
void add_lobe(Digest& digest, const lobe::AnyLobe& lobe) {
  digest.add(lobe.spec());
  if (lobe.is_mirror()) return;
  constexpr int kSamples = 256;
  for (int i = 0; i < kSamples; ++i) {
    const double x = (i + 0.5) / kSamples;
    digest.add(lobe.weight(2 * x * x));
  }
}

void add_bake(Digest& digest, const BakeOptions& options) {
  for (const PrefilterLevel& level : bake_levels(options)) {
    digest.add(level.size.width).add(level.size.height);
    add_lobe(digest, level.lobe);
  }
  const PrefilterOptions& how = options.prefilter;
  digest.add(options.target.spec()).add(options.curve.text()).add(options.keep_alpha).add(how.tolerance);
  digest.add(how.orientation).add(static_cast<int>(how.scale)).add(static_cast<int>(how.mirror_filter));
}

void add_read(Digest& digest, const ReadMapOptions& options) {
  digest.add(options.shape.value_or("")).add(options.faces).add(listed(options.channels, "\n"));
  digest.add(options.layer).add(options.orientation.has_value()).add(options.orientation.value_or(Matrix3{}));
  digest.add(options.eye ? static_cast<int>(*options.eye) : -1).add(static_cast<int>(options.stereo));
  digest.add(options.join_faces).add(options.border).add(options.level);
  digest.add(options.part ? static_cast<double>(*options.part) : -1);
  digest.add(static_cast<int>(options.image.colour)).add(options.image.keep_primaries);
}

void add_write(Digest& digest, const WriteMapOptions& options) {
  const io::WriteOptions& image = options.image;
  digest.add(image.type ? static_cast<int>(*image.type) : -1).add(static_cast<int>(image.colour));
  digest.add(image.compression).add(image.quality).add(options.faces).add(options.border);
  for (const auto& [key, value] : image.attributes) digest.add(key).add(value);
}

/// The files of a frame's source: of six faces, or numbered charts, where its name has a `%s`.
std::vector<fs::path> files_of_source(const fs::path& source) {
  if (!map_file::is_pattern_to_read(source)) return {source};
  std::vector<std::string> names;
  try {
    const auto& faces = map_file::find_face_names(source).faces;
    names.assign(faces.begin(), faces.end());
  } catch (const Error&) {
    std::error_code error;
    for (int i = 0; i == 0 || fs::exists(map_file::chart_path(source, std::to_string(i)), error); ++i)
      names.push_back(std::to_string(i));
  }
  std::vector<fs::path> files;
  for (const std::string& name : names) files.push_back(map_file::chart_path(source, name));
  return files;
}

}  // namespace

std::string request_digest(const FrameNames& in, const BakeFramesOptions& options) {
  Digest digest;
  digest.add("welkin " + std::string(version())).add(fs::absolute(in.name()).lexically_normal().string());
  add_bake(digest, options.bake);
  add_read(digest, options.read);
  add_write(digest, options.write);
  digest.add(options.layout ? options.layout->name : "").add(options.factor).add(options.request);
  return digest.text();
}

std::string digest_of(std::string_view request) {
  Digest digest;
  digest.add(version()).add(request);
  return digest.text();
}

std::string made_note(int frame, const std::string& digest) {
  return std::to_string(frame) + " (" + digest + ")";
}

std::string made_note(int from, int to, int frame, const std::string& digest) {
  const double t = static_cast<double>(frame - from) / (to - from);
  return number_text(1 - t) + "*" + std::to_string(from) + " + " + number_text(t) + "*" + std::to_string(to) +
         " (" + digest + ")";
}

bool is_made(std::span<const fs::path> files, const std::string& note, std::span<const fs::path> sources) {
  std::error_code error;
  fs::file_time_type newest = fs::file_time_type::min();
  for (const fs::path& source : sources) {
    for (const fs::path& each : files_of_source(source)) {
      newest = std::max(newest, fs::last_write_time(each, error));
      if (error) return false;
    }
  }
  for (const fs::path& file : files) {
    if (!(fs::last_write_time(file, error) > newest) || error) return false;
    try {
      const auto reader = io::open(file);
      const auto& attributes = reader->info().attributes;
      const auto found = attributes.find(kFrameKey);
      if (found == attributes.end() || found->second != note) return false;
    } catch (const std::exception&) {
      return false;
    }
  }
  return true;
}

}  // namespace welkin::sequence
