#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/io/image_file.h"

/// Writes textures of every kind for other programs to read, and reads those that they wrote.
///
///     ktx2_samples write FOLDER    makes NAME.ktx2, and NAME.json with the values that went into it
///     ktx2_samples compare A B     fails unless the files hold the same pictures, bit for bit
///     ktx2_samples uastc FOLDER    makes NAME.ktx2 of UASTC HDR, and NAME.values: the halves that we read
///     from it ktx2_samples near A B LIMIT  prints the error of B's pictures, of ln(v + 0.01), and fails if
///     it is above LIMIT
namespace {

using namespace welkin;
namespace fs = std::filesystem;

struct Sample {
  std::string name;
  int width, height, levels, layers, faces, channels;
  io::PixelType type;
  std::string compression;
};

const std::vector<Sample>& samples() {
  using enum io::PixelType;
  static const std::vector<Sample> all = {{"picture", 7, 5, 1, 1, 1, 3, float32, "none"},
                                          {"picture-alpha-mips", 13, 6, 4, 1, 1, 4, half, "none"},
                                          {"picture-grey", 6, 9, 2, 1, 1, 1, rgb9e5, "zstd"},
                                          {"array", 4, 3, 2, 3, 1, 3, r11g11b10, "none"},
                                          {"cube", 8, 8, 1, 1, 6, 3, float32, "zstd"},
                                          {"cube-mips-float", 16, 16, 5, 1, 6, 3, float32, "none"},
                                          {"cube-mips-half-zstd", 16, 16, 5, 1, 6, 3, half, "zstd"},
                                          {"cube-mips-rgb9e5", 16, 16, 5, 1, 6, 3, rgb9e5, "none"},
                                          {"cube-mips-r11g11b10-zstd", 16, 16, 5, 1, 6, 3, r11g11b10, "zstd"},
                                          {"cube-array", 4, 4, 3, 2, 6, 4, half, "zstd"}};
  return all;
}

/// Radiance from 2^-20 to 2^15, now and then 0.
Image picture(int width, int height, int channels, std::mt19937& random) {
  Image image(width, height, channels);
  std::uniform_real_distribution<float> exponent(-20, 15);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * channels; ++i)
      image.view().row(y)[i] = random() % 16 == 0 ? 0.0f : std::exp2(exponent(random));
  }
  return image;
}

void write_values(std::FILE* out, const io::WritePart& part) {
  std::fprintf(out, "{\"level\":%d,\"layer\":%d,\"face\":%d,\"width\":%d,\"height\":%d,\"values\":[",
               part.level, part.layer, part.face, part.image.width, part.image.height);
  for (int y = 0; y < part.image.height; ++y) {
    for (int i = 0; i < part.image.width * part.image.channels; ++i)
      std::fprintf(out, "%s%.9g", y + i == 0 ? "" : ",", static_cast<double>(part.image.row(y)[i]));
  }
  std::fprintf(out, "]}");
}

void write_sample(const fs::path& folder, const Sample& sample) {
  static const std::vector<std::string> names[] = {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  std::mt19937 random(1);
  std::vector<std::unique_ptr<const Image>> images;
  std::vector<io::WritePart> parts;
  for (int level = 0; level < sample.levels; ++level) {
    for (int layer = 0; layer < sample.layers; ++layer) {
      for (int face = 0; face < sample.faces; ++face) {
        images.push_back(
            std::make_unique<Image>(picture(std::max(1, sample.width >> level),
                                            std::max(1, sample.height >> level), sample.channels, random)));
        parts.push_back({"", images.back()->view(), names[sample.channels - 1], level, layer, face});
      }
    }
  }
  io::WriteOptions options;
  options.type = sample.type;
  options.compression = sample.compression;
  options.attributes = {{"welkin.parameterization", "cube"}, {"Übung", "a \"quoted\" line\nand √2"}};
  io::write(folder / (sample.name + ".ktx2"), parts, options);

  std::FILE* out = std::fopen((folder / (sample.name + ".json")).c_str(), "w");
  if (out == nullptr) throw Error(ErrorKind::mismatch, sample.name + ".json cannot be written");
  std::fprintf(out,
               "{\"width\":%d,\"height\":%d,\"levels\":%d,\"layers\":%d,\"faces\":%d,\"channels\":%d,"
               "\"type\":\"%s\",\"compression\":\"%s\",\"keys\":{\"welkin.parameterization\":\"cube\","
               "\"Übung\":\"a \\\"quoted\\\" line\\nand √2\"},\n\"pictures\":[",
               sample.width, sample.height, sample.levels, sample.layers == 1 ? 0 : sample.layers,
               sample.faces, sample.channels, std::string(io::name_of(sample.type)).c_str(),
               sample.compression.c_str());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::fprintf(out, i == 0 ? "\n" : ",\n");
    write_values(out, parts[i]);
  }
  std::fprintf(out, "]}\n");
  if (std::fclose(out) != 0) throw Error(ErrorKind::mismatch, sample.name + ".json cannot be written");
}

Image read_part(io::Reader& reader, std::size_t part) {
  const io::PartInfo& info = reader.info().parts.at(part);
  std::vector<int> channels;
  for (std::size_t k = 0; k < info.channels.size(); ++k) channels.push_back(static_cast<int>(k));
  Image image(info.width, info.height, static_cast<int>(channels.size()));
  reader.read(part, channels, image.view());
  return image;
}

/// Skies and noise: blocks of one colour, of two, smooth ones, and ones that no encoding fits.
Image varied_picture(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> exponent(-12, 12), few(-0.3f, 0.3f);
  Image image(size, size, 3);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(size),
                  v = static_cast<float>(y) / static_cast<float>(size);
      const float colour[3] = {0.2f + u, 0.4f + 0.5f * v, 2 - v};
      const int kind = (x / 16 + y / 16 + static_cast<int>(seed)) % 5;
      for (int c = 0; c < 3; ++c) {
        float value = colour[c];
        if (kind == 1) value = std::exp2(exponent(random));
        if (kind == 2) value *= (x + y) % 16 < 7 ? 60.0f : 0.05f;
        if (kind == 3) value = c == 0 ? 0.0f : 65504.0f;
        if (kind == 4) value *= std::exp2(few(random));
        image.at(x, y)[c] = value;
      }
    }
  }
  return image;
}

std::uint16_t half_of(float value) {
  if (value == 0) return 0;
  int exponent;
  std::frexp(value, &exponent);
  const bool small = exponent < -13;
  const auto mantissa = static_cast<int>(std::ldexp(value, small ? 24 : 11 - exponent));
  return static_cast<std::uint16_t>(small ? mantissa : (exponent + 14) * 1024 + mantissa - 1024);
}

void write_uastc(const fs::path& folder) {
  struct Kind {
    const char* name;
    int size, levels, layers, faces;
    TextureQuality quality;
  };
  for (const Kind& kind : {Kind{"uastc-picture", 80, 1, 1, 1, TextureQuality::best},
                           Kind{"uastc-cube", 64, 7, 1, 6, TextureQuality::fast},
                           Kind{"uastc-array", 48, 2, 3, 1, TextureQuality::normal}}) {
    std::vector<std::unique_ptr<const Image>> images;
    std::vector<io::WritePart> parts;
    for (int level = 0; level < kind.levels; ++level) {
      for (int layer = 0; layer < kind.layers; ++layer) {
        for (int face = 0; face < kind.faces; ++face) {
          const auto seed = static_cast<unsigned>(images.size());
          images.push_back(std::make_unique<Image>(varied_picture(std::max(1, kind.size >> level), seed)));
          parts.push_back({"", images.back()->view(), {"R", "G", "B"}, level, layer, face});
        }
      }
    }
    io::WriteOptions options;
    options.type = io::PixelType::uastc_hdr;
    options.texture_quality = kind.quality;
    const fs::path path = folder / (std::string(kind.name) + ".ktx2");
    io::write(path, parts, options);
    std::ofstream values(folder / (std::string(kind.name) + ".values"), std::ios::binary);
    const auto reader = io::open(path);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Image image = read_part(*reader, i);
      for (int y = 0; y < image.height(); ++y) {
        for (int k = 0; k < 3 * image.width(); ++k) {
          const std::uint16_t half = half_of(image.at(0, y)[k]);
          values.write(reinterpret_cast<const char*>(&half), sizeof half);
        }
      }
    }
    values.close();
    if (!values) throw Error(ErrorKind::mismatch, std::string(kind.name) + ".values cannot be written");
  }
}

void near(const fs::path& a_path, const fs::path& b_path, double limit) {
  const auto a = io::open(a_path), b = io::open(b_path);
  if (a->info().parts.size() != b->info().parts.size())
    throw Error(ErrorKind::mismatch, "different numbers of pictures");
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < a->info().parts.size(); ++i) {
    const Image x = read_part(*a, i), y = read_part(*b, i);
    for (int row = 0; row < x.height(); ++row) {
      for (int k = 0; k < x.channels() * x.width(); ++k, ++count)
        sum += std::pow(std::log((y.at(0, row)[k] + 0.01) / (x.at(0, row)[k] + 0.01)), 2);
    }
  }
  const double error = std::sqrt(sum / count);
  std::printf("%s: %.4f from %s\n", b_path.filename().c_str(), error, a_path.filename().c_str());
  if (!(error <= limit)) throw Error(ErrorKind::mismatch, "the difference is above " + std::to_string(limit));
}

void compare(const fs::path& a_path, const fs::path& b_path) {
  const auto a = io::open(a_path), b = io::open(b_path);
  if (a->info().parts.size() != b->info().parts.size())
    throw Error(ErrorKind::mismatch, "different numbers of pictures");
  for (std::size_t i = 0; i < a->info().parts.size(); ++i) {
    const io::PartInfo &of_a = a->info().parts[i], &of_b = b->info().parts[i];
    const bool same = of_a.name == of_b.name && of_a.width == of_b.width && of_a.height == of_b.height &&
                      of_a.channels == of_b.channels && of_a.type == of_b.type;
    if (!same) throw Error(ErrorKind::mismatch, of_a.name + " and " + of_b.name + " are not alike");
    const Image x = read_part(*a, i), y = read_part(*b, i);
    for (int row = 0; row < x.height(); ++row) {
      const auto bytes = static_cast<std::size_t>(x.width()) * of_a.channels.size() * sizeof(float);
      if (std::memcmp(x.at(0, row), y.at(0, row), bytes) != 0)
        throw Error(ErrorKind::mismatch, of_a.name + " differs in row " + std::to_string(row));
    }
  }
  for (const auto& [key, value] : a->info().attributes) {
    const auto found = b->info().attributes.find(key);
    if (found == b->info().attributes.end() || found->second != value)
      throw Error(ErrorKind::mismatch, "key " + key + " differs");
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string job = argc > 1 ? argv[1] : "";
  try {
    if (job == "write" && argc == 3) {
      for (const Sample& sample : samples()) write_sample(argv[2], sample);
    } else if (job == "compare" && argc == 4) {
      compare(argv[2], argv[3]);
    } else if (job == "uastc" && argc == 3) {
      write_uastc(argv[2]);
    } else if (job == "near" && argc == 5) {
      near(argv[2], argv[3], std::stod(argv[4]));
    } else {
      std::fprintf(stderr,
                   "usage: ktx2_samples write FOLDER | compare A B | uastc FOLDER | near A B LIMIT\n");
      return 2;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ktx2_samples: %s\n", error.what());
    return 1;
  }
  return 0;
}
