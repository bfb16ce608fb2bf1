#include "welkin/io/interpret.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/image/texel_walk.h"
#include "welkin/io/channel_names.h"
#include "welkin/io/colour/code_points.h"
#include "welkin/io/colour/colour_space.h"
#include "welkin/io/colour/gain_map.h"
#include "welkin/io/colour/icc_profile.h"
#include "welkin/io/colour/transfer.h"
#include "welkin/io/xmp.h"

namespace welkin::io {
namespace {

/// Where an upright picture's texels are in the stored one of that width and height (Exif 2.32, 4.6.5.1).
TexelWalk walk_of(int orientation, int width, int height) {
  const int right = width - 1, bottom = height - 1;
  switch (orientation) {
    case 2:
      return {right, 0, -1, 0, 0, 1};
    case 3:
      return {right, bottom, -1, 0, 0, -1};
    case 4:
      return {0, bottom, 1, 0, 0, -1};
    case 5:
      return {0, 0, 0, 1, 1, 0};
    case 6:
      return {0, bottom, 0, -1, 1, 0};
    case 7:
      return {right, bottom, 0, -1, -1, 0};
    case 8:
      return {right, 0, 0, 1, -1, 0};
    default:
      return {};
  }
}

/// Channels of a layer that are one colour: `R G B` or `Y`, with `A`.
struct ColourGroup {
  int r, g, b, y, a;

  bool whole() const { return r >= 0 && g >= 0 && b >= 0; }
};

std::vector<ColourGroup> groups_of(std::span<const std::string> channels) {
  std::vector<ColourGroup> groups;
  for (const ChannelLayer& layer : layers_of_channels(channels)) {
    const auto find = [&](const char* meaning) { return channel_that_is(meaning, channels, layer.members); };
    groups.push_back({find("R"), find("G"), find("B"), find("Y"), find("A")});
  }
  return groups;
}

class InterpretingReader : public Reader {
 public:
  InterpretingReader(std::unique_ptr<FormatReader> reader, const ReadOptions& options)
      : reader_(std::move(reader)), declared_(reader_->declared()), keep_primaries_(options.keep_primaries) {
    std::vector<std::string> notes, warnings;
    choose_colour(options.colour == Colour::automatic, notes, warnings);
    choose_primaries(notes, warnings);
    if (declared_.gain_map)
      notes.push_back("made HDR by its gain map, of up to " + short_text(declared_.gain_map->stops()) +
                      " stops");
    info_ = reader_->info();
    read_xmp(warnings);
    info_.notes.insert(info_.notes.end(), notes.begin(), notes.end());
    info_.warnings.insert(info_.warnings.end(), warnings.begin(), warnings.end());
    const bool alpha = std::any_of(info_.parts.begin(), info_.parts.end(), [](const PartInfo& part) {
      return std::count(part.channels.begin(), part.channels.end(), "A") > 0;
    });
    if (!alpha) declared_.alpha = AlphaKind::associated;
    // Nothing is encoded that is left linear.
    if (declared_.alpha == AlphaKind::encoded && info_.colour != Colour::srgb && curve_ == Curve::none &&
        !profile_)
      declared_.alpha = AlphaKind::associated;
    if (declared_.alpha != AlphaKind::associated)
      info_.notes.push_back(
          declared_.alpha == AlphaKind::straight
              ? "straight alpha: colours are multiplied by it where both are read"
              : "colours were multiplied by alpha when they were encoded; they are linear now");
    if (declared_.orientation != 1) {
      info_.notes.push_back("stored in orientation " + std::to_string(declared_.orientation) +
                            " of Exif; turned upright");
      if (declared_.orientation > 4) {
        for (PartInfo& part : info_.parts) std::swap(part.width, part.height);
      }
    }
  }

  bool does_anything() const {
    return declared_.orientation != 1 || declared_.alpha != AlphaKind::associated || curve_ != Curve::none ||
           matrix_ || profile_ || declared_.gain_map;
  }
  /// The format's reader, with what was found out about it.
  std::unique_ptr<Reader> release() {
    reader_->set_info(std::move(info_));
    return std::move(reader_);
  }

  void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) override {
    const PartInfo& stored = reader_->info().parts[part];
    // Those that are asked for, and those that they depend on.
    std::vector<int> needed(channels.begin(), channels.end());
    const bool encoded = declared_.alpha == AlphaKind::encoded;
    if (mixes() || encoded) {
      for (const ColourGroup& group : groups_of(stored.channels)) {
        const auto need = [&](int c) {
          if (c >= 0 && !is_in(needed, c)) needed.push_back(c);
        };
        const int colours[] = {group.r, group.g, group.b, group.y};
        if (std::none_of(std::begin(colours), std::end(colours), [&](int c) { return is_in(needed, c); }))
          continue;
        if (encoded) need(group.a);
        if (!mixes() || !group.whole()) continue;
        for (const int c : {group.r, group.g, group.b}) need(c);
      }
    }
    std::vector<std::string> names;
    for (const int c : needed) names.push_back(stored.channels[static_cast<std::size_t>(c)]);
    const TexelWalk walk = walk_of(declared_.orientation, stored.width, stored.height);
    if (walk.as_it_is() && needed.size() == channels.size()) {
      reader_->read(part, needed, out);
      convert(names, out);
      return;
    }
    Image picture(stored.width, stored.height, static_cast<int>(needed.size()));
    reader_->read(part, needed, picture.view());
    convert(names, picture.view());
    if (needed.size() == channels.size()) return copy_walked(picture.view(), walk, out);
    parallel_for(out.height, [&](int y) {
      for (int x = 0; x < out.width; ++x)
        std::copy_n(picture.view().at(walk.image_x(x, y), walk.image_y(x, y)), channels.size(), out.at(x, y));
    });
  }

 private:
  static bool is_in(const std::vector<int>& list, int value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  }

  /// Whether a colour depends on others.
  bool mixes() const {
    return matrix_ || declared_.gain_map || curve_ == Curve::hlg || (profile_ && profile_->channels() == 3);
  }

  void choose_colour(bool automatic, std::vector<std::string>& notes, std::vector<std::string>& warnings) {
    if (!declared_.icc.empty()) choose_profile(automatic, notes, warnings);
    if (!automatic || declared_.curve == Curve::none || profile_) return;
    curve_ = declared_.curve;
    gamma_ = declared_.gamma;
    reader_->set_colour(Colour::linear);
    if (curve_ == Curve::pq || curve_ == Curve::hlg)
      notes.push_back(std::string(curve_ == Curve::pq ? "PQ" : "HLG") +
                      ", made linear: 1 is diffuse white, " +
                      std::to_string(static_cast<int>(kDiffuseWhite)) + " cd/m²");
    if (curve_ == Curve::bt709) notes.push_back("BT.709's transfer function, made linear");
    if (curve_ == Curve::gamma) notes.push_back("a power of " + short_text(gamma_) + ", made linear");
  }

  void choose_profile(bool automatic, std::vector<std::string>& notes, std::vector<std::string>& warnings) {
    try {
      auto profile = std::make_unique<IccProfile>(declared_.icc);
      const std::string name =
          "its ICC profile" + (profile->name().empty() ? "" : " '" + profile->name() + "'");
      const auto& channels = reader_->info().parts[0].channels;
      const bool grey = std::find(channels.begin(), channels.end(), "Y") != channels.end();
      if (const auto points = profile->code_points()) {
        FileInfo said;
        declare_code_points(points->primaries, points->transfer, declared_, said);
        notes.insert(notes.end(), said.notes.begin(), said.notes.end());
        warnings.insert(warnings.end(), said.warnings.begin(), said.warnings.end());
        notes.push_back(name + " says its code points");
        if (automatic && declared_.curve == Curve::none) reader_->set_colour(said.colour);
      } else if (grey != (profile->channels() == 1)) {
        warnings.push_back(name + " is of " +
                           (grey ? "R G B, but the picture grey" : "grey, but the picture R G B") +
                           "; it is ignored");
      } else if (profile->is_srgb()) {
        if (automatic) reader_->set_colour(Colour::srgb);
        notes.push_back(name + " is sRGB");
      } else if (!automatic) {
        warnings.push_back(name + " is ignored, since the transfer function was named");
      } else {
        if (keep_primaries_ && !profile->has_primaries())
          warnings.push_back(name +
                             " is a table of colours: converted to the primaries of BT.709 all the same");
        reader_->set_colour(Colour::linear);
        notes.push_back(name + ", made linear" + (keep_primaries_ ? "" : " in BT.709's primaries"));
        // Gains are of the profile's own primaries.
        curves_alone_ = keep_primaries_ || (declared_.gain_map && profile->has_primaries());
        if (curves_alone_ && !keep_primaries_ && profile->channels() == 3) matrix_ = profile->to_bt709();
        profile_ = std::move(profile);
        declared_.primaries.reset();
      }
    } catch (const Error& error) {
      warnings.push_back("its ICC profile is ignored: " + error.cause());
    }
  }

  void read_xmp(std::vector<std::string>& warnings) {
    if (declared_.xmp.empty()) return;
    try {
      if (const auto panorama = panorama_from(Xmp(declared_.xmp), warnings)) info_.panorama = panorama;
    } catch (const Error& error) {
      warnings.push_back(error.cause() + "; what it says of a panorama is not known");
    }
  }

  void choose_primaries(std::vector<std::string>& notes, std::vector<std::string>& warnings) {
    if (!declared_.primaries || profile_) return;
    try {
      if (is_bt709(*declared_.primaries)) return;
      const auto pair = [](const double(&xy)[2]) { return short_text(xy[0]) + " " + short_text(xy[1]); };
      const Chromaticities& c = *declared_.primaries;
      const std::string text = "primaries R " + pair(c.red) + ", G " + pair(c.green) + ", B " + pair(c.blue) +
                               ", white " + pair(c.white);
      if (keep_primaries_) {
        warnings.push_back(text + " are kept; what is written will not say so");
        return;
      }
      matrix_ = to_bt709(c);
      notes.push_back(text + ", converted to BT.709's");
    } catch (const Error& error) {
      warnings.push_back("its primaries are ignored: " + error.cause());
    }
  }

  static std::string short_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
  }

  void convert(std::span<const std::string> names, ImageView<float> pixels) const {
    for (const ColourGroup& group : groups_of(names)) {
      const int y = group.y >= 0 && !group.whole() ? group.y : -1;
      if (declared_.alpha == AlphaKind::encoded && group.a >= 0) divide(group, pixels);
      if (profile_ && group.whole() && profile_->channels() == 3)
        profile_->to_linear(pixels, group.r, group.g, group.b, curves_alone_);
      if (profile_ && y >= 0 && profile_->channels() == 1)
        profile_->to_linear(pixels, y, y, y, curves_alone_);
      if (declared_.gain_map) {
        if (curve_ != Curve::none) convert_colours(group, pixels, curve_, {});
        if (group.whole()) declared_.gain_map->apply(pixels, group.r, group.g, group.b);
        if (y >= 0) declared_.gain_map->apply(pixels, y, y, y);
        if (matrix_) convert_colours(group, pixels, Curve::none, matrix_);
      } else if (curve_ != Curve::none || matrix_) {
        convert_colours(group, pixels, curve_, matrix_);
      }
      if (declared_.alpha != AlphaKind::associated && group.a >= 0) multiply(group, pixels);
    }
  }

  /// Runs body(pixel) over all.
  template <class Body>
  static void each_pixel(ImageView<float> pixels, const Body& body) {
    parallel_for(pixels.height, [&](int row) {
      for (int x = 0; x < pixels.width; ++x) body(pixels.at(x, row));
    });
  }

  void convert_colours(const ColourGroup& group, ImageView<float> pixels, Curve curve,
                       const std::optional<Matrix3>& matrix) const {
    const int colours[] = {group.r, group.g, group.b, group.y};
    each_pixel(pixels, [&](float* pixel) {
      double rgb[3] = {};
      for (int k = 0; k < 4; ++k) {
        const int c = colours[k];
        if (c < 0) continue;
        if (curve != Curve::none)
          pixel[c] = static_cast<float>(to_linear(curve, gamma_, static_cast<double>(pixel[c])));
        if (k < 3) rgb[k] = static_cast<double>(pixel[c]);
      }
      if (curve == Curve::hlg && group.y >= 0)
        pixel[group.y] = static_cast<float>(static_cast<double>(pixel[group.y]) *
                                            hlg_display_gain(static_cast<double>(pixel[group.y])));
      if (!group.whole()) return;
      if (curve == Curve::hlg) {
        const double gain = hlg_display_gain(kHlgLuminance[0] * rgb[0] + kHlgLuminance[1] * rgb[1] +
                                             kHlgLuminance[2] * rgb[2]);
        for (double& value : rgb) value *= gain;
      }
      const Vec3d linear = matrix ? *matrix * Vec3d{rgb[0], rgb[1], rgb[2]} : Vec3d{rgb[0], rgb[1], rgb[2]};
      pixel[group.r] = static_cast<float>(linear.x);
      pixel[group.g] = static_cast<float>(linear.y);
      pixel[group.b] = static_cast<float>(linear.z);
    });
  }

  /// Takes alpha out of the encoded colours, so that a curve meets what was encoded. Without alpha there is
  /// nothing to be taken out.
  void divide(const ColourGroup& group, ImageView<float> pixels) const {
    const bool srgb = reader_->info().colour == Colour::srgb;  // undone by the format
    each_pixel(pixels, [&](float* pixel) {
      const auto alpha = static_cast<double>(pixel[group.a]);
      if (!(alpha > 0)) return;
      for (const int c : {group.r, group.g, group.b, group.y}) {
        if (c < 0) continue;
        const auto value = static_cast<double>(pixel[c]);
        const double stored = srgb ? linear_to_srgb(value) : value;
        // Lossy coding leaves colours greater than their alpha.
        const double whole = std::min(stored / alpha, std::max(1.0, stored));
        pixel[c] = static_cast<float>(srgb ? srgb_to_linear(whole) : whole);
      }
    });
  }

  void multiply(const ColourGroup& group, ImageView<float> pixels) const {
    const bool divided = declared_.alpha == AlphaKind::encoded;
    each_pixel(pixels, [&](float* pixel) {
      const float alpha = pixel[group.a];
      if (divided && !(alpha > 0)) return;
      for (const int c : {group.r, group.g, group.b, group.y}) {
        if (c >= 0) pixel[c] *= alpha;
      }
    });
  }

  std::unique_ptr<FormatReader> reader_;
  Declared declared_;
  bool keep_primaries_;
  Curve curve_ = Curve::none;
  double gamma_ = 1;
  std::optional<Matrix3> matrix_;
  bool curves_alone_ = false;  ///< of the profile: primaries stay, or wait for matrix_
  std::unique_ptr<IccProfile> profile_;
};

}  // namespace

std::unique_ptr<Reader> interpret(std::unique_ptr<FormatReader> reader, const ReadOptions& options) {
  auto interpreting = std::make_unique<InterpretingReader>(std::move(reader), options);
  if (!interpreting->does_anything()) return interpreting->release();
  return interpreting;
}

}  // namespace welkin::io
