#include "welkin/io/xmp.h"

#include "welkin/io/jpeg/jpeg_test_files.h"
#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

/// A packet with these attributes on its description, and these elements in it.
std::string packet(const std::string& attributes, const std::string& elements = "") {
  return "<?xpacket begin=''?><x:xmpmeta xmlns:x='adobe:ns:meta/'><rdf:RDF "
         "xmlns:rdf='http://www.w3.org/1999/02/22-rdf-syntax-ns#'><rdf:Description rdf:about='' " +
         attributes + ">" + elements + "</rdf:Description></rdf:RDF></x:xmpmeta><?xpacket end='w'?>";
}

const std::string kSpace = "http://ns.google.com/photos/1.0/panorama/";

TEST(Xmp, AttributesAndElementsOfAnyPrefixAreFound) {
  const Xmp xmp(packet("xmlns:g='" + kSpace + "' g:PoseHeadingDegrees=' 350.5 '",
                       "<other:ProjectionType xmlns:other='" + kSpace +
                           "'>equirectangular</other:ProjectionType>"
                           "<g:List><rdf:Seq><rdf:li>1</rdf:li><rdf:li>2</rdf:li></rdf:Seq></g:List>"));
  EXPECT_EQ(xmp.number(kSpace, "PoseHeadingDegrees"), 350.5);
  EXPECT_EQ(xmp.text(kSpace, "ProjectionType"), "equirectangular");
  EXPECT_EQ(xmp.texts(kSpace, "List"), (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(xmp.text("http://ns.google.com/photos/1.0/image/", "ProjectionType"), std::nullopt);
  EXPECT_EQ(xmp.text(kSpace, "Nothing"), std::nullopt);
}

TEST(Xmp, PanoramasGoBothWays) {
  Panorama panorama{"equirectangular", 8192, 4096, 4096, 1024};
  panorama.crop_left = 2048;
  panorama.crop_top = 512;
  panorama.heading = 271.25;
  panorama.pitch = -3;
  panorama.roll = 0.5;
  std::vector<std::string> warnings;
  EXPECT_EQ(panorama_from(Xmp(xmp_of(panorama)), warnings), panorama);
  EXPECT_TRUE(warnings.empty());
}

TEST(Xmp, APrefixMeansWhatTheInnermostElementSays) {
  const Xmp xmp(packet("xmlns:a='one' xmlns:b='two' a:Heading='1'",
                       "<a:Pitch xmlns:a='three'>2</a:Pitch><a:Roll>3</a:Roll><a:Heading>4</a:Heading>"
                       "<none:Name>5</none:Name><Name>6</Name>"));
  EXPECT_EQ(xmp.text("one", "Heading"), "1");
  EXPECT_EQ(xmp.text("one", "Pitch"), std::nullopt);
  EXPECT_EQ(xmp.text("three", "Pitch"), "2");
  EXPECT_EQ(xmp.text("one", "Roll"), "3");
  EXPECT_EQ(xmp.text("two", "Roll"), std::nullopt);
}

TEST(Xmp, WideCharactersAndPaddingAreRead) {
  const std::string text = packet("xmlns:a='one' a:Heading='1'");
  for (const std::size_t unit : {1u, 2u, 4u}) {
    for (const bool little : {false, true}) {
      std::string wide;
      for (const char c : text) {
        std::string character(unit, '\0');
        character[little ? 0 : unit - 1] = c;
        wide += character;
      }
      for (const std::size_t padding : {0u, 1u, 4u, 100u})
        EXPECT_EQ(Xmp(wide + std::string(padding * unit, '\0')).text("one", "Heading"), "1")
            << unit << little << padding;
    }
  }
  EXPECT_THROW(Xmp(std::string(8, '\0')), Error);
  EXPECT_THROW(Xmp(""), Error);
}

TEST(Xmp, DeepAndLongPacketsTakeNoLongerThanTheirBytes) {
  // Each name was once looked up in all elements around it, which took minutes.
  constexpr int kElements = 100'000;
  std::string opened, closed, attributes;
  for (int i = 0; i < kElements; ++i) {
    opened += "<a:ProjectionType>";
    closed += "</a:ProjectionType>";
    attributes += " b:FullPanoWidthPixels='1'";
  }
  std::vector<std::string> warnings;
  EXPECT_EQ(panorama_from(Xmp(opened + closed), warnings), std::nullopt);
  EXPECT_EQ(panorama_from(Xmp("<x" + attributes + "/>"), warnings), std::nullopt);
  EXPECT_TRUE(warnings.empty());
}

TEST(Xmp, AnyProjectionIsWrittenAsItIs) {
  Panorama panorama;
  for (const std::string projection : {"a\" b='<&>'", "a\tb\nc\rd", "\xc3\xa9"}) {
    panorama.projection = projection;
    std::vector<std::string> warnings;
    EXPECT_EQ(panorama_from(Xmp(xmp_of(panorama)), warnings), panorama);
  }
}

TEST(Xmp, NumbersThatCannotBeMeantAreTold) {
  std::vector<std::string> warnings;
  const auto panorama =
      panorama_from(Xmp(packet("xmlns:GPano='" + kSpace +
                               "' GPano:ProjectionType='equirectangular' GPano:FullPanoWidthPixels='many' "
                               "GPano:FullPanoHeightPixels='-4' GPano:CroppedAreaLeftPixels='1e300' "
                               "GPano:CroppedAreaTopPixels='0x10' "
                               "GPano:PosePitchDegrees='nan'")),
                    warnings);
  ASSERT_TRUE(panorama);
  EXPECT_EQ(panorama->full_width, 0);
  EXPECT_EQ(panorama->pitch, 0);
  EXPECT_EQ(warnings.size(), 5u);
}

TEST(Xmp, PacketsWithoutAPanoramaSayNothing) {
  std::vector<std::string> warnings;
  EXPECT_EQ(panorama_from(Xmp(packet("")), warnings), std::nullopt);
  EXPECT_TRUE(warnings.empty());
}

TEST(Xmp, StereoAndTheOtherEyeAreTold) {
  std::vector<std::string> warnings;
  const auto panorama = panorama_from(
      Xmp(packet("xmlns:s='http://ns.google.com/videos/1.0/spherical/' s:StereoMode='top-bottom' "
                 "xmlns:GImage='http://ns.google.com/photos/1.0/image/' GImage:Mime='image/jpeg'")),
      warnings);
  ASSERT_TRUE(panorama);
  EXPECT_EQ(panorama->stereo, Stereo::top_bottom);
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(Xmp, DamageIsAnErrorAndDepthIsSurvived) {
  const std::string whole = packet("xmlns:GPano='" + kSpace + "' GPano:ProjectionType='equirectangular'");
  for (std::size_t size = 30; size < whole.find("</x:xmpmeta>"); size += 7)
    EXPECT_THROW(Xmp(whole.substr(0, size)), Error) << size;
  std::string deep;
  for (int i = 0; i < 200000; ++i) deep += "<a>";
  for (int i = 0; i < 200000; ++i) deep += "</a>";
  const Xmp xmp(packet("", deep));
  EXPECT_EQ(xmp.text(kSpace, "ProjectionType"), std::nullopt);
}

TEST(Xmp, TheFirstOfTwoPacketsCounts) {
  WriteOptions options;
  options.panorama = Panorama{"equirectangular", 64, 32, 16, 8};
  const Bytes bytes = encoded("jpg", noise(16, 8, 3), options);
  Panorama other{"equirectangular", 128, 64, 16, 8};
  const FileInfo info = info_of(with_marker(bytes, '\xe1', std::string(kXmpMarker) + xmp_of(other)));
  EXPECT_EQ(info.panorama, other);
  EXPECT_EQ(info.warnings.size(), 1u);
}

TEST(Xmp, EveryFormatThatCarriesItDoes) {
  Panorama panorama{"equirectangular", 64, 32, 16, 8};
  panorama.crop_left = 24;
  panorama.crop_top = 12;
  WriteOptions options;
  options.panorama = panorama;
  options.attributes = {{"Title", "part"}};
  for (const std::string extension : {"jpg", "png", "tif", "webp"}) {
    if (extension == "webp") options.attributes.clear();
    const Bytes bytes = encoded(extension, noise(16, 8, 3), options);
    const FileInfo info = info_of(bytes);
    EXPECT_EQ(info.panorama, panorama) << extension;
    EXPECT_EQ(info.attributes, options.attributes) << extension;
    EXPECT_TRUE(info.warnings.empty()) << extension;
    options.panorama.reset();
    expect_same(decoded(bytes), decoded(encoded(extension, noise(16, 8, 3), options)));
    options.panorama = panorama;
  }
}

}  // namespace
}  // namespace welkin::io::test
