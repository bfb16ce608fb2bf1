#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/io/image_file.h"

/// What the tests of this room's formats share.
namespace welkin::io::test {

/// An empty folder that goes away with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static std::atomic<int> count{0};
    path_ = std::filesystem::temp_directory_path() /
            ("welkin-io-test-" + std::to_string(std::random_device()()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  /// How many entries it holds, hidden ones included.
  int entries() const {
    int count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(path_)) ++count;
    return count;
  }

 private:
  std::filesystem::path path_;
};

using Bytes = std::vector<std::byte>;

inline Bytes bytes_of(std::string_view text) {
  const auto* data = reinterpret_cast<const std::byte*>(text.data());
  return {data, data + text.size()};
}

inline Bytes file_bytes(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return bytes_of(std::string(std::istreambuf_iterator<char>(stream), {}));
}

/// Values in [0, 1), no two pixels alike; of two or four channels, the last is alpha and the others are
/// multiplied by it.
inline Image noise(int width, int height, int channels, unsigned seed = 1) {
  Image image(width, height, channels);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * channels; ++i) image.view().row(y)[i] = uniform(random);
    for (int x = 0; channels % 2 == 0 && x < width; ++x) {
      float* const pixel = image.view().at(x, y);
      for (int c = 0; c + 1 < channels; ++c) pixel[c] *= pixel[channels - 1];
    }
  }
  return image;
}

inline std::vector<std::string> names_of(int channels) {
  static const std::vector<std::string> names[] = {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  return names[channels - 1];
}

/// The picture as a file of that extension.
inline Bytes encoded(const std::string& extension, const Image& image, const WriteOptions& options = {},
                     WriteReport* report = nullptr) {
  const TemporaryFolder folder;
  const auto path = folder / ("picture." + extension);
  const WritePart part{"", image.view(), names_of(image.channels())};
  const WriteReport lost = write(path, {&part, 1}, options);
  if (report != nullptr) *report = lost;
  EXPECT_EQ(folder.entries(), 1) << "a temporary file was left";
  return file_bytes(path);
}

inline Image read_part(Reader& reader, std::size_t part = 0) {
  const PartInfo& info = reader.info().parts.at(part);
  std::vector<int> channels;
  for (int k = 0; k < static_cast<int>(info.channels.size()); ++k) channels.push_back(k);
  Image image(info.width, info.height, static_cast<int>(channels.size()));
  reader.read(part, channels, image.view());
  return image;
}

inline Image decoded(const Bytes& bytes, const ReadOptions& options = {}) {
  return read_part(*open(bytes, "test", options));
}

inline FileInfo info_of(const Bytes& bytes, const ReadOptions& options = {}) {
  return open(bytes, "test", options)->info();
}

/// Bit for bit, so that NaN equals itself and −0 is not 0.
inline void expect_same(const Image& a, const Image& b) {
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  ASSERT_EQ(a.channels(), b.channels());
  for (int y = 0; y < a.height(); ++y) {
    for (int i = 0; i < a.width() * a.channels(); ++i) {
      ASSERT_EQ(std::memcmp(a.view().row(y) + i, b.view().row(y) + i, sizeof(float)), 0)
          << "row " << y << ", value " << i << ": " << a.view().row(y)[i] << " and " << b.view().row(y)[i];
    }
  }
}

inline float largest_difference(const Image& a, const Image& b) {
  float largest = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int i = 0; i < a.width() * a.channels(); ++i) {
      largest = std::max(largest, std::abs(a.view().row(y)[i] - b.view().row(y)[i]));
    }
  }
  return largest;
}

/// The message of the Error that `action` must throw.
template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

/// Opening or reading each beginning of the file, but the whole and the last `optional` bytes, is an Error.
inline void expect_truncation_is_an_error(const Bytes& bytes, std::size_t optional = 0) {
  for (std::size_t size = 0; size + optional < bytes.size(); ++size) {
    const Bytes part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(decoded(part), Error) << "cut to " << size << " of " << bytes.size() << " bytes";
  }
}

/// Whatever one byte is changed to, reading ends in a picture or in an Error.
inline void expect_damage_is_survived(const Bytes& bytes) {
  ReadOptions options;
  options.max_bytes = 1 << 20;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const int change : {0x01, 0x80, 0xff}) {
      Bytes damaged = bytes;
      damaged[at] ^= static_cast<std::byte>(change);
      try {
        const Image image = decoded(damaged, options);
        EXPECT_GT(image.width(), 0);
      } catch (const Error& error) {
        EXPECT_STRNE(error.what(), "");
      }
    }
  }
}

}  // namespace welkin::io::test
