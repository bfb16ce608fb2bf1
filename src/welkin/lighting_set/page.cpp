#include "welkin/lighting_set/page.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "welkin/base/parallel.h"
#include "welkin/base/version.h"
#include "welkin/brdf/dfg_table.h"
#include "welkin/harmonics/zonal.h"
#include "welkin/io/shared_exponent.h"
#include "welkin/lighting_set/encoded_files.h"
#include "welkin/lighting_set/page_pictures.h"
#include "welkin/lighting_set/resources.h"
#include "welkin/map/borders.h"

namespace welkin {
namespace {

using lighting_set::PagePictures;
using nlohmann::ordered_json;

/// The viewer's cube has faces of this size or less, so that the page stays small.
constexpr int kViewerFaces = 256;
/// Crosses of larger faces would only make the page larger.
constexpr int kCrossFaces = 128;
constexpr int kBallPixels = 160;
constexpr int kTableSide = 32;
/// What the mean luminance becomes in pictures: middle grey.
constexpr double kMiddleGrey = 0.18;

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

/// With so many significant digits, without an exponent where that is short.
std::string digits(double value, int count) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, count).ptr;
  return {text, end};
}

std::string percent(double share) {
  return share == 0 ? "0" : share < 1e-6 ? "&lt; 0.0001" : digits(100 * share, 3);
}

/// `1 234 567` with thin spaces.
std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::ptrdiff_t i = static_cast<std::ptrdiff_t>(text.size()) - 3; i > 0; i -= 3)
    text.insert(static_cast<std::size_t>(i), "\u202f");
  return text;
}

std::string size_text(ChartSize size) {
  return std::to_string(size.width) + "×" + std::to_string(size.height);
}

/// Of the mean over the sphere: red, green, blue, or the only channel.
double mean_luminance(const harmonics::SphericalHarmonics& light) {
  const double y00 = std::sqrt(1 / (4 * kPi));
  if (light.channels() < 3) return light.at(0, 0, 0) * y00;
  return y00 * (0.2126 * light.at(0, 0, 0) + 0.7152 * light.at(0, 0, 1) + 0.0722 * light.at(0, 0, 2));
}

std::string bytes_as_base64(std::span<const std::byte> bytes) {
  const std::string url = data_url("", bytes);
  return url.substr(url.find(',') + 1);
}

class Page {
 public:
  Page(const LightingSet& set, const SetRequest& request, const Monitor& monitor)
      : set_(set), request_(request) {
    const double mean = mean_luminance(set.light);
    pictures_.exposure = mean > 0 ? kMiddleGrey / mean : 1;
    pictures_.monitor = without_progress(monitor);
  }

  std::string text() {
    head();
    viewer();
    levels();
    files();
    how_to_load();
    formats();
    html_ += "<p class=\"faint\">welkin " + std::string(version()) + "</p>\n";
    html_ += "<script>\n";
    html_ += lighting_set::kPageViewer;
    html_ += "</script>\n</html>\n";
    return std::move(html_);
  }

 private:
  void head() {
    const std::string title = "Light of " + escaped(request_.source.empty() ? "a map" : request_.source) +
                              " for " + escaped(set_.engine.title);
    html_ += "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n";
    html_ += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" + title +
             "</title>\n<style>\n";
    html_ += lighting_set::kPageStyle;
    html_ += "</style>\n<h1>" + title + "</h1>\n<p>" + escaped(set_.engine.summary) + ".</p>\n";
    for (const std::string& warning : set_.warnings)
      html_ += "<p class=\"warning\">" + escaped(warning) + "</p>\n";
  }

  void viewer() {
    html_ += R"(<figure class="viewer" id="viewer" hidden>
<canvas id="canvas" tabindex="0" aria-label="A ball lit by the set; drag or use the arrow keys to look around"></canvas>
<div class="controls">
<label>roughness <input id="roughness" type="range" min="0" max="1" step="0.01" value="0.2"><output id="roughness-value"></output></label>
<label>background blur <input id="blur" type="range" min="0" max="1" step="0.01" value="0"></label>
<label>exposure <input id="exposure" type="range" min="-6" max="6" step="0.1" value="0"><output id="exposure-value"></output></label>
<label><input id="metal" type="checkbox" checked> metal</label>
<label>colour <input id="colour" type="color" value="#f4e2c8"></label>
</div>
<figcaption>Drag to look around, wheel to come nearer. The ball is lit by the files' own texels: the specular chain by the split sum,
with a second bounce, and the harmonics for diffuse light.</figcaption>
</figure>
)";
    html_ += "<figure class=\"wide\"><img alt=\"the world as a lat-long\" src=\"" +
             pictures_.panorama(set_.world) + "\"><figcaption>The world";
    if (request_.width > 0)
      html_ += ": " + escaped(request_.source) + ", " + escaped(request_.parameterization) + " of " +
               size_text({request_.width, request_.height});
    html_ += ". Pictures on this page are multiplied by " + digits(pictures_.exposure, 3) +
             ", clipped, and written in sRGB; the files hold linear radiance.</figcaption></figure>\n";
    html_ += "<script id=\"data\" type=\"application/json\">" + viewer_data() + "</script>\n";
  }

  /// What viewer.js reads.
  std::string viewer_data() const {
    const Chain& chain = set_.specular;
    std::size_t first = 0;
    while (first + 1 < chain.levels.size() && chain.levels[first].width() > kViewerFaces) ++first;
    ordered_json data{{"exposure", pictures_.exposure}};
    const Matrix3& world = chain.levels.front().orientation;
    for (const auto& row : world.rows) {
      for (const double value : row) data["world"].push_back(value);
    }
    for (std::size_t i = first; i < chain.levels.size(); ++i) {
      const double even =
          static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(1, chain.levels.size() - 1));
      data["roughness"].push_back(i < chain.notes.roughness.size() ? chain.notes.roughness[i] : even);
      data["levels"].push_back({{"width", chain.levels[i].width()}, {"faces", faces_of(chain.levels[i])}});
    }
    for (int i = 0; i < set_.light.count(); ++i) {
      for (int c = 0; c < 3; ++c) {
        data["harmonics"].push_back(set_.light.values()[static_cast<std::size_t>(
            i * set_.light.channels() + (set_.light.channels() < 3 ? 0 : c))]);
      }
    }
    data["table"] = table();
    return data.dump();
  }

  /// Shared exponents, as GPUs read them: 9 + 9 + 9 + 5 bits.
  static std::string faces_of(const Map& level) {
    std::vector<std::uint32_t> words;
    for (int chart = 0; chart < level.charts(); ++chart) {
      const ImageView<const float> face = level.level.chart(chart);
      for (int y = 0; y < face.height; ++y) {
        for (int x = 0; x < face.width; ++x) {
          const float* texel = face.at(x, y);
          const auto value = [&](int c) {
            return std::clamp(texel[face.channels < 3 ? 0 : c], 0.0f, io::kLargestSharedExponent);
          };
          words.push_back(io::shared_exponent_of(value(0), value(1), value(2)));
        }
      }
    }
    return bytes_as_base64(std::as_bytes(std::span(words)));
  }

  static std::string table() {
    brdf::DfgTable table;
    table.width = table.height = kTableSide;
    const Image image = brdf::make_dfg_table(table);
    return bytes_as_base64(std::as_bytes(std::span(image.at(0, 0), kTableSide * kTableSide * 2)));
  }

  void levels() {
    const Chain& chain = set_.specular;
    const auto specular = std::find_if(set_.files.begin(), set_.files.end(), [](const MadeFile& file) {
      return file.made.content == SetContent::specular;
    });
    const bool is_stored = specular != set_.files.end();
    html_ += "<h2>The specular chain</h2>\n";
    if (!is_stored)
      html_ += "<p>The set's files hold it in another way; this is what it should come to.</p>\n";
    html_ += "<div class=\"cards\">\n";
    for (std::size_t i = 0; i < chain.levels.size(); ++i) {
      const Map& level = chain.levels[i];
      html_ += "<div class=\"card\"><h3>";
      html_ += i < chain.notes.roughness.size() ? "roughness " + digits(chain.notes.roughness[i], 3) : "";
      html_ += " <small>level " + std::to_string(i) + ", " + size_text({level.width(), level.height()}) +
               "</small></h3><div class=\"pair\"><img class=\"ball\" alt=\"ball that reflects level " +
               std::to_string(i) + "\" src=\"" + pictures_.mirror_ball(level, kBallPixels) + "\">";
      if (level.width() <= kCrossFaces) {
        html_ += "<img class=\"cross" + std::string(level.width() <= 32 ? " texels" : "") +
                 "\" alt=\"faces of level " + std::to_string(i) + "\" src=\"" + pictures_.cross(level) +
                 "\">";
      }
      html_ += "</div>";
      if (is_stored) html_ += errors_of(specular->levels[i]);
      html_ += "</div>\n";
    }
    html_ += "</div>\n";
    for (const MadeFile& file : set_.files) {
      if (!file.levels.empty() && file.levels.front().verification) return;
    }
    html_ +=
        "<p class=\"faint\">Each level was filtered aiming for a relative RMS error of " +
        percent(request_.tolerance) +
        " %; this was not measured here. <em>Stored</em> is what the texels of the file differ by from what "
        "was filtered.</p>\n";
  }

  static std::string errors_of(const SetLevel& level) {
    std::string text = "<p class=\"faint\">stored: relative RMSE " + percent(level.stored.relative_rmse()) +
                       " %, RMSLE " + digits(level.stored.rmsle(), 2);
    if (level.verification) {
      const ReferenceErrors& reference = level.verification->reference;
      text += "; against brute force: relative RMSE " + percent(reference.relative_rmse) + " %, at most " +
              percent(reference.maximum) + " %";
    }
    return text + "</p>";
  }

  void files() {
    html_ +=
        "<h2>The files</h2>\n<div class=\"scroll\"><table>\n<tr><th>file</th><th>bytes</th><th>what it "
        "is</th><th>levels</th><th>texels</th></tr>\n";
    for (const MadeFile& file : set_.files) {
      const SetFile& made = file.made;
      html_ += "<tr><td><code>" + escaped(made.name) + "</code></td><td>" + grouped(file.bytes.size()) +
               "</td><td class=\"words\">" + std::string(name_of(made.content)) + ": " + escaped(made.about) +
               "</td><td>";
      if (!file.levels.empty()) {
        html_ += std::to_string(file.levels.size()) + " from " + size_text(file.levels.front().size);
      }
      html_ += "</td><td>" + escaped(made.type) +
               (made.compression.empty() ? "" : " + " + escaped(made.compression)) + "</td></tr>\n";
    }
    html_ += "</table></div>\n<p class=\"faint\"><code>manifest.json</code> has all of it for programs.";
    if (!request_.command.empty()) html_ += " Made by:";
    html_ += "</p>\n";
    if (!request_.command.empty()) html_ += "<pre>" + escaped(request_.command) + "</pre>\n";
    diffuse_balls();
    if (request_.sun) tell_sun();
  }

  void diffuse_balls() {
    html_ +=
        "<div class=\"beside\"><img class=\"ball\" alt=\"white diffuse ball, lit by the harmonics\" src=\"" +
        pictures_.normal_ball(diffuse_map(), kBallPixels) +
        "\"><p>A white diffuse ball, lit by the nine harmonics. Over all directions their irradiance is off "
        "by " +
        percent(set_.light_error) + " % (relative RMSE); nowhere is it negative.</p></div>\n";
  }

  /// Irradiance / π by the harmonics.
  Map diffuse_map() const;

  void tell_sun() {
    if (request_.sun->lights.empty()) {
      html_ += "<p>No sun stood out of the map, so none was taken out.</p>\n";
      return;
    }
    const ExtractedLight& sun = request_.sun->lights.front();
    html_ +=
        "<p>The strongest light was taken out of the map, to be a light of its own that casts shadows: "
        "towards " +
        digits(sun.direction.x, 4) + ", " + digits(sun.direction.y, 4) + ", " + digits(sun.direction.z, 4) +
        ", irradiance ";
    for (std::size_t c = 0; c < sun.irradiance.size(); ++c)
      html_ += (c > 0 ? ", " : "") + digits(sun.irradiance[c], 4);
    html_ += ".</p>\n";
  }

  void how_to_load() {
    html_ += "<h2>How to load it</h2>\n";
    if (!set_.engine.snippet.empty()) html_ += "<pre>" + escaped(set_.engine.snippet) + "</pre>\n";
    if (set_.engine.name == engines().front().name) return;
    html_ += "<p class=\"faint\">";
    html_ += set_.engine.run ? "Such sets were loaded and rendered in the engine itself."
                             : "The engine was not run: what it takes was read in its source.";
    html_ += " Source: " + escaped(set_.engine.source) + ".</p>\n";
  }

  void formats() {
    if (set_.formats.empty()) return;
    html_ +=
        "<h2>Bytes and errors of other texels</h2>\n<div class=\"scroll\"><table>\n<tr><th>specular chain as "
        "KTX2</th><th>bytes</th><th>relative RMSE %</th><th>RMSLE</th><th></th></tr>\n";
    for (const FormatChoice& choice : set_.formats) {
      html_ += "<tr><td>" + escaped(choice.type) +
               (choice.compression == "none" ? "" : " + " + choice.compression) + "</td><td>" +
               grouped(choice.bytes) + "</td><td>" + percent(choice.relative_rmse) + "</td><td>" +
               digits(choice.rmsle, 2) + "</td><td>" + (choice.loads ? "" : "not loaded by this engine") +
               "</td></tr>\n";
    }
    html_ += "</table></div>\n";
  }

  const LightingSet& set_;
  const SetRequest& request_;
  PagePictures pictures_;
  std::string html_;
};

Map Page::diffuse_map() const {
  constexpr int kFaces = 32;
  const harmonics::SphericalHarmonics diffuse = harmonics::convolved(
      set_.light, harmonics::lobe_factors(lobe::AnyLobe::make("lambert"), set_.light.degree()));
  Map map(sphere::AnyParameterization::make("cube"), kFaces, kFaces, diffuse.channels());
  map.channel_names = diffuse.channel_names;
  std::vector<double> value(static_cast<std::size_t>(diffuse.channels()));
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < kFaces; ++y) {
      for (int x = 0; x < kFaces; ++x) {
        diffuse.evaluate(map.parameterization.to_sphere(chart, (x + 0.5) / kFaces, (y + 0.5) / kFaces),
                         value);
        std::transform(value.begin(), value.end(), map.level.chart(chart).at(x, y),
                       [](double v) { return static_cast<float>(v); });
      }
    }
  }
  fill_borders(map);
  return map;
}

}  // namespace

std::string page_text(const LightingSet& set, const SetRequest& request, const Monitor& monitor) {
  return Page(set, request, monitor).text();
}

}  // namespace welkin
