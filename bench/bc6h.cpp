// BC6H and UASTC HDR: how far blocks are from what was given, and how long they take, on one thread.

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness.h"
#include "pictures.h"
#include "welkin/filter/resample.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/synth/render_synth.h"
#include "welkin/texture/astc_hdr.h"
#include "welkin/texture/bc6h.h"
#include "welkin/texture/uastc_to_bc6h.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr int kFace = 256;

struct Errors {
  double rmsle = 0, relative = 0;
};

/// Against the picture clamped to what halves hold.
void add_errors(ImageView<const float> picture, ImageView<const float> decoded, Errors& errors) {
  for (int y = 0; y < picture.height; ++y) {
    for (int i = 0; i < 3 * picture.width; ++i) {
      const double a = std::clamp(static_cast<double>(picture.row(y)[i]), 0.0, 65504.0),
                   b = static_cast<double>(decoded.row(y)[i]);
      errors.rmsle += std::pow(std::log1p(a) - std::log1p(b), 2);
      errors.relative += std::pow((b - a) / (a + 0.01), 2);
    }
  }
}

Errors mean(const Errors& sums, const Map& map) {
  const double count = 3.0 * map.charts() * map.width() * map.height();
  return {std::sqrt(sums.rmsle / count), std::sqrt(sums.relative / count)};
}

/// What blocks of UASTC HDR become as BC6H, as decode_bc6h decodes it. Of sides that are multiples of 4.
void decode_as_bc6h(std::span<const std::byte> blocks, ImageView<float> picture) {
  const std::byte* block = blocks.data();
  std::uint16_t halves[48];
  for (int y = 0; y < picture.height; y += 4) {
    for (int x = 0; x < picture.width; x += 4, block += 16) {
      texture::uastc::decode_as_bc6h(block, halves);
      for (int i = 0; i < 48; ++i)
        picture.at(x + i / 3 % 4, y + i / 12)[i % 3] = imath_half_to_float(halves[i]);
    }
  }
}

std::string text(const char* format, double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

constexpr std::pair<const char*, TextureQuality> kQualities[] = {
    {"fast", TextureQuality::fast}, {"normal", TextureQuality::normal}, {"best", TextureQuality::best}};

template <class Encode>
std::string time_of(const Map& map, const Encode& encode) {
  const double texels = 1e-6 * map.charts() * map.width() * map.height();
  const Timing timing = time_jobs({[&] {
                                    for (int chart = 0; chart < map.charts(); ++chart)
                                      encode(map.level.chart(chart));
                                  }},
                                  3)[0];
  return text("%.3f", timing.median().cpu / texels) + text(" (%.3f)", timing.best().cpu / texels);
}

void measure_bc6h(const Table& table, const std::string& name, const Map& map) {
  std::vector<std::byte> blocks(bc6h_bytes(map.width(), map.height()));
  Image decoded(map.width(), map.height(), 3);
  for (const auto& [word, quality] : kQualities) {
    const auto encode = [&, quality = quality](ImageView<const float> picture) {
      encode_bc6h(picture, quality, blocks);
    };
    Errors sums;
    for (int chart = 0; chart < map.charts(); ++chart) {
      encode(map.level.chart(chart));
      decode_bc6h(blocks, false, decoded.view());
      add_errors(map.level.chart(chart), decoded.view(), sums);
    }
    const Errors errors = mean(sums, map);
    table.row({name, word, text("%.5f", errors.rmsle), text("%.5f", errors.relative), time_of(map, encode)});
  }
}

void measure_uastc_hdr(const Table& table, const std::string& name, const Map& map) {
  std::vector<std::byte> blocks(astc_bytes(map.width(), map.height()));
  Image decoded(map.width(), map.height(), 3);
  for (const auto& [word, quality] : kQualities) {
    const auto encode = [&, quality = quality](ImageView<const float> picture) {
      encode_uastc_hdr(picture, quality, blocks);
    };
    Errors as_astc, as_bc6h;
    for (int chart = 0; chart < map.charts(); ++chart) {
      encode(map.level.chart(chart));
      decode_astc_hdr(blocks, decoded.view());
      add_errors(map.level.chart(chart), decoded.view(), as_astc);
      decode_as_bc6h(blocks, decoded.view());
      add_errors(map.level.chart(chart), decoded.view(), as_bc6h);
    }
    as_astc = mean(as_astc, map);
    as_bc6h = mean(as_bc6h, map);
    table.row({name, word, text("%.5f", as_astc.rmsle), text("%.5f", as_astc.relative),
               text("%.5f", as_bc6h.rmsle), text("%.5f", as_bc6h.relative), time_of(map, encode)});
  }
}

/// Cubes of an HDRI, of a level that is pre-filtered, and of worlds.
std::vector<std::pair<std::string, Map>> cubes() {
  std::vector<std::pair<std::string, Map>> all;
  const auto cube = sphere::AnyParameterization::make("cube");
  const HighDynamicRange hdri = high_dynamic_range();
  Map resampled(cube, kFace, kFace, 3);
  resample(hdri.map, resampled);
  all.emplace_back(hdri.name, std::move(resampled));
  all.emplace_back(hdri.name + ", ggx of roughness ⅛",
                   std::move(prefilter_map(
                       hdri.map, cube, {{{kFace, kFace}, lobe::AnyLobe::make("ggx,roughness=0.125")}})[0]));
  for (const char* world : {"studio", "sky"})
    all.emplace_back(world, render(synth::make(world), cube, kFace, kFace, {2}));
  return all;
}

}  // namespace

int main() {
  const Threads one(1);
  const std::vector<std::pair<std::string, Map>> maps = cubes();
  std::printf(
      "\n## BC6H\n\nCubes of 6×%d as blocks of BC6H, by `--quality`. *RMSLE*: of ln(v + 1). *Relative*: rms "
      "of the difference over v + "
      "0.01. One thread; CPU seconds for a million texels.\n\n",
      kFace);
  const Table bc6h({"picture", "quality", "RMSLE", "relative", "CPU s"});
  for (const auto& [name, map] : maps) measure_bc6h(bc6h, name, map);
  std::printf(
      "\n## UASTC HDR 4×4\n\nThe same as blocks of UASTC HDR, which are ASTC on phones and become BC6H on "
      "other "
      "graphics cards.\n\n");
  const Table uastc({"picture", "quality", "RMSLE", "relative", "RMSLE as BC6H", "relative", "CPU s"});
  for (const auto& [name, map] : maps) measure_uastc_hdr(uastc, name, map);
}
