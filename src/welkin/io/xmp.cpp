#include "welkin/io/xmp.h"

#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <unordered_map>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"

namespace welkin::io {
namespace {

constexpr std::string_view kPanoramaSpace = "http://ns.google.com/photos/1.0/panorama/";
constexpr std::string_view kSphericalSpace = "http://ns.google.com/videos/1.0/spherical/";
constexpr std::string_view kImageSpace = "http://ns.google.com/photos/1.0/image/";
constexpr std::string_view kRdfSpace = "http://www.w3.org/1999/02/22-rdf-syntax-ns#";

std::string trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kSpace) - first + 1));
}

/// All properties of a packet by namespace and name, found in one walk without recursion, so that neither
/// depth nor length of a hostile packet costs more than its bytes. The views are of the document's own text.
class Properties : private pugi::xml_tree_walker {
 public:
  explicit Properties(pugi::xml_document& document) { document.traverse(*this); }

  /// The texts of the first one of that name; null when there is none.
  const std::vector<std::string>* find(std::string_view space, std::string_view name) const {
    const auto found = properties_.find({space, name});
    return found == properties_.end() ? nullptr : &found->second.texts;
  }

 private:
  using Name = std::pair<std::string_view, std::string_view>;  ///< namespace, name
  struct Property {
    std::vector<std::string> texts;
    bool array = false;
  };
  /// An element that the walk is in.
  struct Element {
    std::vector<std::string_view> prefixes;  ///< that it binds
    Property* property = nullptr;            ///< that it is, where it is the first of its name
  };

  bool for_each(pugi::xml_node& node) override {
    while (open_.size() > static_cast<std::size_t>(depth())) leave();
    Element element;
    for (const pugi::xml_attribute attribute : node.attributes()) {
      constexpr std::string_view kDeclaration = "xmlns:";
      const std::string_view name = attribute.name();
      if (!name.starts_with(kDeclaration)) continue;
      element.prefixes.push_back(name.substr(kDeclaration.size()));
      spaces_[element.prefixes.back()].push_back(attribute.value());
    }
    for (const pugi::xml_attribute attribute : node.attributes()) {
      const auto name = resolved(attribute.name());
      if (!name) continue;
      const auto [place, first] = properties_.try_emplace(*name);
      if (first) place->second.texts.push_back(trimmed(attribute.value()));
    }
    if (const auto name = resolved(node.name())) {
      if (*name == Name{kRdfSpace, "li"}) {
        add_item(node);
      } else {
        const auto [place, first] = properties_.try_emplace(*name);
        if (first) {
          place->second.texts.push_back(trimmed(node.text().get()));
          element.property = &place->second;
        }
      }
    }
    open_.push_back(std::move(element));
    return true;
  }

  /// An item lies in an array, which lies in its property.
  void add_item(const pugi::xml_node& item) {
    Property* const property = open_.size() < 2 ? nullptr : open_[open_.size() - 2].property;
    if (property == nullptr) return;
    if (!property->array) property->texts.clear();
    property->array = true;
    property->texts.push_back(trimmed(item.text().get()));
  }

  std::optional<Name> resolved(std::string_view qualified) const {
    const std::size_t colon = qualified.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const auto found = spaces_.find(qualified.substr(0, colon));
    if (found == spaces_.end() || found->second.empty()) return std::nullopt;
    return Name{found->second.back(), qualified.substr(colon + 1)};
  }

  void leave() {
    for (const std::string_view prefix : open_.back().prefixes) spaces_[prefix].pop_back();
    open_.pop_back();
  }

  std::map<Name, Property> properties_;
  std::unordered_map<std::string_view, std::vector<std::string_view>> spaces_;  ///< by prefix, innermost last
  std::vector<Element> open_;
};

/// Packets end in spaces or zeros, for edits in place. Zeros go, but those that are half of a character.
std::string_view without_padding(std::string_view packet) {
  const std::string_view start = packet.substr(0, 4);
  const std::size_t unit = start.find(std::string_view("\0\0", 2)) != start.npos ? 4  // UTF-32
                           : start.find('\0') != start.npos                      ? 2  // UTF-16
                                                                                 : 1;
  const std::size_t last = packet.find_last_not_of('\0');
  const std::size_t size = last == packet.npos ? 0 : last + 1;
  return packet.substr(0, (size + unit - 1) / unit * unit);
}

/// As the value of an attribute in double quotes.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&' || c == '<' || c == '>' || c == '"' || static_cast<unsigned char>(c) < ' ') {
      result += "&#" + std::to_string(static_cast<int>(c)) + ";";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace

struct Xmp::Document {
  pugi::xml_document xml;
  std::optional<Properties> properties;
};

Xmp::Xmp(std::string_view packet) : document_(std::make_unique<Document>()) {
  packet = without_padding(packet);
  const pugi::xml_parse_result result = document_->xml.load_buffer(packet.data(), packet.size());
  if (!result) throw Error(ErrorKind::damaged, std::string("its XMP is malformed: ") + result.description());
  document_->properties.emplace(document_->xml);
}

Xmp::~Xmp() = default;

std::vector<std::string> Xmp::texts(std::string_view space, std::string_view name) const {
  const auto* const found = document_->properties->find(space, name);
  return found == nullptr ? std::vector<std::string>() : *found;
}

std::optional<std::string> Xmp::text(std::string_view space, std::string_view name) const {
  const auto* const found = document_->properties->find(space, name);
  return found == nullptr || found->empty() ? std::nullopt : std::optional(found->front());
}

std::optional<double> Xmp::number(std::string_view space, std::string_view name) const {
  const auto found = text(space, name);
  return found ? parse_number(*found) : std::nullopt;
}

std::optional<Panorama> panorama_from(const Xmp& xmp, std::vector<std::string>& warnings) {
  Panorama panorama;
  constexpr double kLongest = 1 << 26;
  const auto said = [&](const char* name) { return xmp.text(kPanoramaSpace, name); };
  const auto whole = [&](const char* name, int& value, double least) {
    const auto text = said(name);
    if (!text) return;
    const auto number = parse_number(*text);
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
    const auto number = parse_number(*text);
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
  if (!panorama.projection.empty()) add("ProjectionType", escaped(panorama.projection));
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
