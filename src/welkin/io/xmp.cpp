#include "welkin/io/xmp.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <pugixml.hpp>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"

namespace welkin::io {
namespace {

constexpr std::string_view kPanoramaSpace = "http://ns.google.com/photos/1.0/panorama/";
constexpr std::string_view kSphericalSpace = "http://ns.google.com/videos/1.0/spherical/";
constexpr std::string_view kImageSpace = "http://ns.google.com/photos/1.0/image/";
constexpr std::string_view kRdfSpace = "http://www.w3.org/1999/02/22-rdf-syntax-ns#";

/// Whether `qualified` at this node is that name of that namespace.
bool is_named(const pugi::xml_node& node, std::string_view qualified, std::string_view space,
              std::string_view name) {
  const std::size_t colon = qualified.find(':');
  if (colon == std::string_view::npos || qualified.substr(colon + 1) != name) return false;
  const std::string declaration = "xmlns:" + std::string(qualified.substr(0, colon));
  for (pugi::xml_node each = node; each; each = each.parent()) {
    if (const pugi::xml_attribute found = each.attribute(declaration.c_str())) return found.value() == space;
  }
  return false;
}

/// Visits nodes without recursion, so that no depth of a hostile file exhausts the stack.
template <class Visit>
struct Walker : pugi::xml_tree_walker {
  explicit Walker(const Visit& visit_node) : visit(visit_node) {}
  bool for_each(pugi::xml_node& node) override { return visit(node); }
  const Visit& visit;
};

template <class Visit>
void walk(pugi::xml_document& document, const Visit& visit) {
  Walker<Visit> walker(visit);
  document.traverse(walker);
}

std::string trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kSpace) - first + 1));
}

std::optional<double> number_from(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

struct Xmp::Document {
  mutable pugi::xml_document xml;
};

Xmp::Xmp(std::string_view packet) : document_(std::make_unique<Document>()) {
  // Packets end in spaces or zeros, for edits in place.
  while (!packet.empty() && packet.back() == '\0') packet.remove_suffix(1);
  const pugi::xml_parse_result result = document_->xml.load_buffer(packet.data(), packet.size());
  if (!result) throw Error(ErrorKind::damaged, std::string("its XMP is malformed: ") + result.description());
}

Xmp::~Xmp() = default;

std::vector<std::string> Xmp::texts(std::string_view space, std::string_view name) const {
  std::vector<std::string> found;
  walk(document_->xml, [&](const pugi::xml_node& node) {
    for (const pugi::xml_attribute attribute : node.attributes()) {
      if (is_named(node, attribute.name(), space, name)) found.push_back(trimmed(attribute.value()));
    }
    if (!found.empty()) return false;
    if (!is_named(node, node.name(), space, name)) return true;
    for (const pugi::xml_node array : node.children()) {
      for (const pugi::xml_node item : array.children()) {
        if (is_named(item, item.name(), kRdfSpace, "li")) found.push_back(trimmed(item.text().get()));
      }
    }
    if (found.empty()) found.push_back(trimmed(node.text().get()));
    return false;
  });
  return found;
}

std::optional<std::string> Xmp::text(std::string_view space, std::string_view name) const {
  const std::vector<std::string> all = texts(space, name);
  return all.empty() ? std::nullopt : std::optional(all.front());
}

std::optional<double> Xmp::number(std::string_view space, std::string_view name) const {
  const auto found = text(space, name);
  return found ? number_from(*found) : std::nullopt;
}

std::optional<Panorama> panorama_from(const Xmp& xmp, std::vector<std::string>& warnings) {
  Panorama panorama;
  constexpr double kLongest = 1 << 26;
  const auto said = [&](const char* name) { return xmp.text(kPanoramaSpace, name); };
  const auto whole = [&](const char* name, int& value, double least) {
    const auto text = said(name);
    if (!text) return;
    const auto number = number_from(*text);
    if (number && *number >= least && *number <= kLongest && *number == std::floor(*number)) {
      value = static_cast<int>(*number);
    } else {
      warnings.push_back("its GPano:" + std::string(name) + " is '" + text->substr(0, 40) +
                         "', which is no number of pixels; ignored");
    }
  };
  const auto degrees = [&](const char* name, double& value) {
    const auto text = said(name);
    if (!text) return;
    const auto number = number_from(*text);
    if (number && std::fabs(*number) <= 360) {
      value = *number;
    } else {
      warnings.push_back("its GPano:" + std::string(name) + " is '" + text->substr(0, 40) +
                         "', which is no angle; ignored");
    }
  };
  panorama.projection = said("ProjectionType").value_or("");
  whole("FullPanoWidthPixels", panorama.full_width, 1);
  whole("FullPanoHeightPixels", panorama.full_height, 1);
  whole("CroppedAreaImageWidthPixels", panorama.crop_width, 1);
  whole("CroppedAreaImageHeightPixels", panorama.crop_height, 1);
  whole("CroppedAreaLeftPixels", panorama.crop_left, 0);
  whole("CroppedAreaTopPixels", panorama.crop_top, -kLongest);
  degrees("PoseHeadingDegrees", panorama.heading);
  degrees("PosePitchDegrees", panorama.pitch);
  degrees("PoseRollDegrees", panorama.roll);
  std::optional<std::string> stereo = said("StereoMode");
  if (!stereo) stereo = xmp.text(kSphericalSpace, "StereoMode");
  if (stereo == "mono") panorama.stereo = Stereo::mono;
  if (stereo == "top-bottom") panorama.stereo = Stereo::top_bottom;
  if (stereo == "left-right") panorama.stereo = Stereo::left_right;
  if (stereo && panorama.stereo == Stereo::not_said)
    warnings.push_back("its stereo mode '" + stereo->substr(0, 40) + "' is not known");
  if (xmp.text(kImageSpace, "Mime"))
    warnings.push_back("the other eye's picture lies in its XMP (GImage), which is not read");
  if (panorama == Panorama{}) return std::nullopt;
  return panorama;
}

std::string xmp_of(const Panorama& panorama) {
  std::string properties;
  const auto add = [&](const char* name, const std::string& value) {
    properties += "\n    GPano:" + std::string(name) + "=\"" + value + "\"";
  };
  if (!panorama.projection.empty()) add("ProjectionType", panorama.projection);
  add("UsePanoramaViewer", "True");
  if (panorama.full_width > 0) add("FullPanoWidthPixels", std::to_string(panorama.full_width));
  if (panorama.full_height > 0) add("FullPanoHeightPixels", std::to_string(panorama.full_height));
  if (panorama.crop_width > 0) add("CroppedAreaImageWidthPixels", std::to_string(panorama.crop_width));
  if (panorama.crop_height > 0) add("CroppedAreaImageHeightPixels", std::to_string(panorama.crop_height));
  if (panorama.crop_width > 0) add("CroppedAreaLeftPixels", std::to_string(panorama.crop_left));
  if (panorama.crop_height > 0) add("CroppedAreaTopPixels", std::to_string(panorama.crop_top));
  if (panorama.heading != 0) add("PoseHeadingDegrees", number_text(panorama.heading));
  if (panorama.pitch != 0) add("PosePitchDegrees", number_text(panorama.pitch));
  if (panorama.roll != 0) add("PoseRollDegrees", number_text(panorama.roll));
  return "<?xpacket begin=\"\xef\xbb\xbf\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
         "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
         " <rdf:RDF xmlns:rdf=\"" +
         std::string(kRdfSpace) +
         "\">\n"
         "  <rdf:Description rdf:about=\"\" xmlns:GPano=\"" +
         std::string(kPanoramaSpace) + "\"" + properties +
         "/>\n </rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"w\"?>";
}

}  // namespace welkin::io
