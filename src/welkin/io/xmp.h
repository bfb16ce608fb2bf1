#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/io/image_file.h"

namespace welkin::io {

/// An XMP packet (ISO 16684-1): properties by namespace and name, whatever their prefixes, as attributes or
/// as elements.
class Xmp {
 public:
  /// Throws Error (damaged) for what is no XML.
  explicit Xmp(std::string_view packet);
  ~Xmp();

  /// The property's text; of an array the first.
  std::optional<std::string> text(std::string_view space, std::string_view name) const;
  /// All texts of an array, or the one of a simple property.
  std::vector<std::string> texts(std::string_view space, std::string_view name) const;
  /// The number that is all of the text.
  std::optional<double> number(std::string_view space, std::string_view name) const;

 private:
  struct Document;
  std::unique_ptr<Document> document_;
};

/// What a JPEG's APP1 marker with a packet begins with, and the keyword of PNG's iTXt (ISO 16684-3).
inline constexpr std::string_view kXmpMarker("http://ns.adobe.com/xap/1.0/\0", 29);
inline constexpr const char* kXmpKeyword = "XML:com.adobe.xmp";

inline constexpr std::string_view kHdrGainMapSpace = "http://ns.adobe.com/hdr-gain-map/1.0/";

/// What the packet says of a panorama: GPano of Google's Photo Sphere XMP Metadata, and the stereo mode of
/// its Spherical Video. Nothing when it says nothing. What is said but can't be meant adds to `warnings`.
std::optional<Panorama> panorama_from(const Xmp& xmp, std::vector<std::string>& warnings);

/// A packet that says that.
std::string xmp_of(const Panorama& panorama);

}  // namespace welkin::io
