#include "metadata_seeds.h"

#include <lcms2.h>
#include <zlib.h>

#include <fstream>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "welkin/image/image.h"
#include "welkin/io/image_file.h"
#include "welkin/io/xmp.h"

namespace welkin::fuzz {
namespace {

namespace fs = std::filesystem;

using Named = std::vector<std::pair<std::string, std::string>>;  ///< names and bytes

std::string big_endian(std::size_t value, int bytes = 4) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 255);
  return text;
}

void save(const fs::path& path, const std::string& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream stream(path, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream.good()) throw std::runtime_error(path.string() + " cannot be written");
}

/// A small picture as a file of that extension.
std::string encoded(const fs::path& folder, const std::string& extension, int width, int height) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      image.at(x, y)[x % 3] = static_cast<float>(y + 1) / static_cast<float>(height);
  }
  const io::WritePart part{"", image.view(), {"R", "G", "B"}};
  io::WriteOptions options;
  options.type = io::PixelType::uint8;
  const fs::path path = folder / ("made." + extension);
  io::write(path, {&part, 1}, options);
  std::string bytes;
  {
    std::ifstream stream(path, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
  }
  fs::remove(path);
  return bytes;
}

// ------------------------------------------------------------------------------------------------- XMP
// packets

std::string described(const std::string& attributes, const std::string& elements) {
  return "<x:xmpmeta xmlns:x='adobe:ns:meta/'><rdf:RDF "
         "xmlns:rdf='http://www.w3.org/1999/02/22-rdf-syntax-ns#'>"
         "<rdf:Description xmlns:g='http://ns.google.com/photos/1.0/panorama/' "
         "xmlns:h='http://ns.adobe.com/hdr-gain-map/1.0/' "
         "xmlns:s='http://ns.google.com/videos/1.0/spherical/' "
         "xmlns:i='http://ns.google.com/photos/1.0/image/' " +
         attributes + ">" + elements + "</rdf:Description></rdf:RDF></x:xmpmeta>";
}

/// ASCII as UTF-16 or UTF-32 in big-endian order, with its mark.
std::string widened(const std::string& text, int bytes) {
  std::string wide = big_endian(0xfeff, bytes);
  for (const char c : text) wide += big_endian(static_cast<unsigned char>(c), bytes);
  return wide;
}

Named xmp_packets() {
  io::Panorama panorama{"equirectangular", 8192, 4096, 4096, 1024};
  panorama.crop_left = 2048;
  panorama.heading = 271.25;
  panorama.pitch = -3;
  const std::string stereo = described("s:StereoMode='top-bottom' i:Mime='image/jpeg'", "");
  return {{"panorama", io::xmp_of(panorama)},
          {"stereo", stereo},
          {"elements", described("",
                                 "<g:ProjectionType>cylindrical</g:ProjectionType>"
                                 "<g:PoseRollDegrees>0.5</g:PoseRollDegrees>")},
          {"gain_map", described("h:Version='1.0' h:GainMapMin='0' h:GainMapMax='3' h:Gamma='1' "
                                 "h:OffsetSDR='0.0156' h:OffsetHDR='0.0156' h:BaseRenditionIsHDR='False'",
                                 "")},
          {"gain_maps", described("",
                                  "<h:GainMapMax><rdf:Seq><rdf:li>1</rdf:li><rdf:li>2</rdf:li>"
                                  "<rdf:li>3</rdf:li></rdf:Seq></h:GainMapMax>")},
          {"utf16", widened(stereo, 2)},
          {"utf32", widened(stereo, 4)},
          {"entities", "<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;&#x41;&lt;<![CDATA[d]]><!-- e --></a>"}};
}

// ------------------------------------------------------------------------------------------------ ICC
// profiles

using Profile = std::unique_ptr<void, decltype(&cmsCloseProfile)>;
using ToneCurve = std::unique_ptr<cmsToneCurve, decltype(&cmsFreeToneCurve)>;
using Pipeline = std::unique_ptr<cmsPipeline, decltype(&cmsPipelineFree)>;

std::string saved(const Profile& profile) {
  cmsUInt32Number size = 0;
  if (profile == nullptr || cmsSaveProfileToMem(profile.get(), nullptr, &size) == 0)
    throw std::runtime_error("a profile cannot be made");
  std::string bytes(size, '\0');
  cmsSaveProfileToMem(profile.get(), bytes.data(), &size);
  return bytes;
}

Profile of_primaries(const ToneCurve& curve) {
  const cmsCIExyY white = {0.3127, 0.3290, 1};
  const cmsCIExyYTRIPLE primaries = {{0.680, 0.320, 1}, {0.265, 0.690, 1}, {0.150, 0.060, 1}};
  cmsToneCurve* curves[3] = {curve.get(), curve.get(), curve.get()};
  return {cmsCreateRGBProfile(&white, &primaries, curves), cmsCloseProfile};
}

/// R G B to XYZ or Lab by a table of 3³ colours.
Profile of_table(cmsTagSignature tag, double version) {
  Profile profile(cmsCreateProfilePlaceholder(nullptr), cmsCloseProfile);
  cmsSetProfileVersion(profile.get(), version);
  cmsSetDeviceClass(profile.get(), cmsSigDisplayClass);
  cmsSetColorSpace(profile.get(), cmsSigRgbData);
  cmsSetPCS(profile.get(), tag == cmsSigDToB1Tag ? cmsSigXYZData : cmsSigLabData);
  const Pipeline pipeline(cmsPipelineAlloc(nullptr, 3, 3), cmsPipelineFree);
  if (tag == cmsSigDToB1Tag) {
    std::vector<cmsFloat32Number> table;
    for (int i = 0; i < 27 * 3; ++i) table.push_back(static_cast<float>(i % 27) / 27);
    cmsPipelineInsertStage(pipeline.get(), cmsAT_END, cmsStageAllocCLutFloat(nullptr, 3, 3, 3, table.data()));
  } else {
    std::vector<cmsUInt16Number> table;
    for (int i = 0; i < 27 * 3; ++i) table.push_back(static_cast<cmsUInt16Number>(i * 800));
    cmsPipelineInsertStage(pipeline.get(), cmsAT_END, cmsStageAllocToneCurves(nullptr, 3, nullptr));
    cmsPipelineInsertStage(pipeline.get(), cmsAT_END, cmsStageAllocCLut16bit(nullptr, 3, 3, 3, table.data()));
    cmsPipelineInsertStage(pipeline.get(), cmsAT_END, cmsStageAllocToneCurves(nullptr, 3, nullptr));
  }
  cmsWriteTag(profile.get(), tag, pipeline.get());
  return profile;
}

Named icc_profiles() {
  const cmsCIExyY white = {0.3457, 0.3585, 1};
  const ToneCurve power(cmsBuildGamma(nullptr, 1.8), cmsFreeToneCurve);
  const cmsFloat64Number srgb[5] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
  const ToneCurve pieces(cmsBuildParametricToneCurve(nullptr, 4, srgb), cmsFreeToneCurve);
  const cmsUInt16Number steps[4] = {0, 9000, 30000, 65535};
  const ToneCurve table(cmsBuildTabulatedToneCurve16(nullptr, 4, steps), cmsFreeToneCurve);
  return {{"srgb", saved({cmsCreate_sRGBProfile(), cmsCloseProfile})},
          {"grey", saved({cmsCreateGrayProfile(&white, power.get()), cmsCloseProfile})},
          {"power", saved(of_primaries(power))},
          {"pieces", saved(of_primaries(pieces))},
          {"table", saved(of_primaries(table))},
          {"lut16", saved(of_table(cmsSigAToB0Tag, 2.1))},
          {"lut_a_to_b", saved(of_table(cmsSigAToB0Tag, 4.3))},
          {"elements", saved(of_table(cmsSigDToB1Tag, 4.3))}};
}

// ---------------------------------------------------------------------------------- Exif blocks and gain
// maps

Named exif_blocks() {
  const std::string entry("\x12\x01\3\0\1\0\0\0\6\0\0\0", 12), end(4, '\0');
  const std::string other("\x0f\x01\2\0\4\0\0\0abc\0", 12);
  return {{"little", std::string("II*\0\x08\0\0\0\1\0", 10) + entry + end},
          {"big", std::string("MM\0*\0\0\0\x08\0\1\x01\x12\0\3\0\0\0\1\0\3\0\0\0\0\0\0", 26)},
          {"second", std::string("II*\0\x08\0\0\0\2\0", 10) + other + entry + end},
          {"loop", std::string("II*\0\x08\0\0\0\1\0", 10) + other + std::string("\x08\0\0\0", 4)}};
}

std::string words(std::initializer_list<std::size_t> values) {
  std::string text;
  for (const std::size_t value : values) text += big_endian(value);
  return text;
}

/// ISO 21496-1's bytes. Fractions: headrooms 0 and 3; then minimum 0, maximum 3, gamma 1, both offsets 0.
Named gain_maps() {
  const std::string version(4, '\0'), of_one = words({0, 1, 3, 1, 1, 1, 1, 64, 1, 64});
  return {{"version", version},
          {"one", version + '\x40' + words({0, 1, 3, 1}) + of_one},
          {"three", version + '\xc0' + words({0, 1, 3, 1}) + of_one + of_one + of_one},
          {"common", version + '\x48' + words({2, 0, 6, 0, 6, 2, 0, 0})},
          {"zero", version + '\x40' + words({0, 1, 3, 1, 0, 0, 3, 0, 0, 0, 1, 64, 1, 64})}};
}

// ------------------------------------------------------------------------------------------ in JPEGs and
// PNGs

std::string with_marker(const std::string& jpeg, char marker, const std::string& body) {
  const std::string segment = std::string("\xff") + marker + big_endian(body.size() + 2, 2) + body;
  return jpeg.substr(0, 2) + segment + jpeg.substr(2);
}

void write_jpegs(const fs::path& folder) {
  const std::string base = encoded(folder, "jpg", 17, 9), small = encoded(folder, "jpg", 5, 3);
  for (const auto& [name, bytes] : exif_blocks())
    save(folder / ("exif_" + name + ".jpg"), with_marker(base, '\xe1', std::string("Exif\0\0", 6) + bytes));
  for (const auto& [name, bytes] : icc_profiles())
    save(folder / ("icc_" + name + ".jpg"),
         with_marker(base, '\xe2', std::string("ICC_PROFILE\0\1\1", 14) + bytes));
  const std::string marker(io::kXmpMarker), iso("urn:iso:std:iso:ts:21496:-1\0", 28);
  const std::string hdr = described("h:Version='1.0'", "");
  for (const auto& [name, bytes] : xmp_packets()) {
    const std::string packed = with_marker(base, '\xe1', marker + bytes);
    save(folder / ("xmp_" + name + ".jpg"), packed);
    save(folder / ("gains_" + name + ".jpg"),
         with_marker(base, '\xe1', marker + hdr) + with_marker(small, '\xe1', marker + bytes));
  }
  for (const auto& [name, bytes] : gain_maps())
    save(folder / ("iso_" + name + ".jpg"),
         with_marker(base, '\xe2', iso + std::string(4, '\0')) + with_marker(small, '\xe2', iso + bytes));
}

std::string chunk(const std::string& name, const std::string& data) {
  const std::string body = name + data;
  const auto* bytes = reinterpret_cast<const Bytef*>(body.data());
  return big_endian(data.size()) + body + big_endian(crc32(0, bytes, static_cast<uInt>(body.size())));
}

std::string deflated(const std::string& raw) {
  std::string packed(compressBound(static_cast<uLong>(raw.size())), '\0');
  auto size = static_cast<uLongf>(packed.size());
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(raw.data()),
           static_cast<uLong>(raw.size()));
  packed.resize(size);
  return packed;
}

void write_pngs(const fs::path& folder) {
  constexpr std::size_t kAfterHeader = 8 + 25;
  const std::string signature("\x89PNG\r\n\x1a\n");
  const auto with = [&](int colour_type, const std::string& chunks, const std::string& late = "") {
    const std::size_t channels = colour_type == 2 ? 3 : 4;
    const std::string header =
        words({5, 3}) + std::string{'\x8', static_cast<char>(colour_type), '\0', '\0', '\0'};
    std::string rows;
    for (std::size_t y = 0; y < 3; ++y) rows += '\0' + std::string(5 * channels, static_cast<char>(60 * y));
    const std::string all = signature + chunk("IHDR", header);
    if (all.size() != kAfterHeader) throw std::runtime_error("a PNG's header has 13 bytes");
    return all + chunks + chunk("IDAT", deflated(rows)) + late + chunk("IEND", "");
  };
  for (const auto& [name, bytes] : exif_blocks())
    save(folder / ("exif_" + name + ".png"), with(2, chunk("eXIf", bytes)));
  const std::string xmp = chunk("iTXt", io::kXmpKeyword + std::string(5, '\0') + xmp_packets()[0].second);
  save(folder / "late.png", with(2, "", chunk("eXIf", exif_blocks()[0].second) + xmp));
  for (const auto& [name, bytes] : icc_profiles())
    save(folder / ("icc_" + name + ".png"),
         with(6, chunk("iCCP", std::string("a\0\0", 3) + deflated(bytes))));
  for (const auto& [name, bytes] : xmp_packets())
    save(folder / ("xmp_" + name + ".png"),
         with(2, chunk("iTXt", io::kXmpKeyword + std::string(5, '\0') + bytes)));
  for (const char transfer : {'\1', '\4', '\x8', '\xd', '\x10', '\x12'})
    save(folder / ("cicp_" + std::to_string(transfer) + ".png"),
         with(6, chunk("cICP", std::string{'\x9', transfer, '\0', '\1'})));
  const std::string primaries = words({31270, 32900, 70800, 29200, 17000, 79700, 13100, 4600});
  save(folder / "chrm.png", with(6, chunk("gAMA", words({45455})) + chunk("cHRM", primaries)));
  save(folder / "chrm_zero.png", with(2, chunk("gAMA", words({0})) + chunk("cHRM", std::string(32, '\0'))));
}

/// Of readers of text and of measurements.
void write_table_seeds(const fs::path& root) {
  std::string grid = "light,view,around,value\n# sr^-1\n";
  for (const char* light : {"0", "45", "90"}) {
    for (const char* view : {"0", "60"}) {
      for (const char* around : {"0", "180"})
        grid += std::string(light) + "," + view + " " + around + ",\t0.25e0\n";
    }
  }
  save(root / "brdf_table" / "grid", grid);
  save(root / "lobe_table" / "csv", "angle,weight\n0,1\n30,.5\n90,0\n");
  save(root / "lobe_table" / "blanks", "\xEF\xBB\xBF# degrees\r\n0 2e3\r\n5\t1\r\n180 0\r\n");
  save(root / "camera_path" / "csv", "# turns\nframe,yaw,pitch,roll,fov\n0,0,0,0,90\n10, 360,-20,5,40\n");
  save(root / "camera_path" / "json", R"([{"frame":0,"yaw":170},{"frame":1.5,"yaw":-170,"roll":720}])");
  const std::string planes("\x10\x20\x80\xEB\x40\x60\x90\xA0\x55\x5A\x70\x81", 12);
  save(root / "frame_stream" / "y4m",
       "YUV4MPEG2 W4 H2 F30000:1001 Ip A1:1 C420jpeg\nFRAME\n" + planes + "FRAME\n" + planes);
  save(root / "frame_stream" / "full", "YUV4MPEG2 W2 H2 C444 XCOLORRANGE=FULL\nFRAME\n" + planes);
  save(root / "frame_stream" / "deep", "YUV4MPEG2 W3 H2 Cmono10\nFRAME\n" + planes);
  save(root / "frame_stream" / "ppm", "P6\n# four\n2 2\n255\n" + planes + "P6\n2 2\n255\n" + planes);
  save(root / "frame_stream" / "pgm", "P5 3 2 1023\n" + planes);
  save(root / "frame_stream" / "pfm", "Pf\n3 1\n-1.0\n" + planes);
  save(root / "merl" / "ones", "r" + std::string("\0\0\0\0\0\0\xF0\x3F", 8));
  save(root / "merl" / "unmeasured", "r" + std::string("\0\0\0\0\0\0\xF0\xBF\0\0\0\0\0\0\xE0\x3F", 16));
  save(root / "merl" / "short", std::string("\x5A\0\0\0\x5A\0\0\0\xB4\0\0\0\0", 13));
  save(root / "coefficients" / "json",
       R"({"order":1,"basis":"orthonormal","coefficients":[[1,1,1],[0,0.5,0],[0,0,0.25],[0.1,0,0]]})");
  save(root / "coefficients" / "csv", "l,m,R,G,B\n0,0,1,1,1\n1,-1,0,0,0\n1,0,.5,.5,.5\n1,1,0,0,0\n");
}

/// A triangle with as much around it as the reader of glTF knows; the same as .glb; a square as OBJ.
void write_scene_seeds(const fs::path& root) {
  const std::string triangle("AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAA=");
  const std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"extensionsUsed":["KHR_lights_punctual"],)"
      R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","color":[1,1,0],"spot":{"outerConeAngle":1}}]}},)"
      R"("nodes":[{"mesh":0,"children":[1,2],"scale":[1,2,3]},{"camera":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,5,1]},)"
      R"({"rotation":[0,0,0,1],"extensions":{"KHR_lights_punctual":{"light":0}}}],)"
      R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":0,"TEXCOORD_0":2},"indices":1,"material":0}]}],)"
      R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":)"
      R"({"offset":[0,1],"scale":[2,2],"rotation":1}}}},"normalTexture":{"index":0},"emissiveFactor":[1,1,1],"extensions":)"
      R"({"KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatTexture":{"index":0}},"KHR_materials_ior":{"ior":2}}}],)"
      R"("textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071}],"images":[{"uri":"data:image/png;base64,)"
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGNoaPgPAAODAgAApfuJAAAAAElFTkSuQmCC"
      R"("}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,"indices":)"
      R"({"bufferView":1,"componentType":5123},"values":{"bufferView":0}}},)"
      R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"},)"
      R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36,"byteStride":12},{"buffer":0,"byteOffset":36,"byteLength":8}],)"
      R"("buffers":[{"byteLength":44)";
  save(root / "scene" / "triangle.gltf", json + R"(,"uri":"data:;base64,)" + triangle + "\"}]}");
  std::string text = json + "}]}";
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
    return bytes;
  };
  const std::string data(
      "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3F\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3F\0\0\0\0\0\0\1\0\2\0\0\0", 44);
  save(root / "scene" / "triangle.glb", "glTF" + word(2) + word(28 + text.size() + data.size()) +
                                            word(text.size()) + "JSON" + text + word(data.size()) +
                                            std::string("BIN\0", 4) + data);
  save(root / "scene" / "square.obj",
       "mtllib a.mtl\nnewmtl m\nKd 1 0 0\nKe 1 1 1\nNs 10\nmap_Kd -s 2 2 1 a.png\nnorm b.png\no s\nv 0 0 "
       "0\nv 1 0 0\n"
       "v 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl m\nf 1/1/1 2/1/1 3/1/1 -1/1/1\nf 1 2 3\n");
}

}  // namespace

void write_metadata_seeds(const fs::path& root) {
  for (const auto& [folder, seeds] : {std::pair{"xmp", xmp_packets()},
                                      {"icc", icc_profiles()},
                                      {"exif", exif_blocks()},
                                      {"gain_map", gain_maps()}}) {
    for (const auto& [name, bytes] : seeds) save(root / folder / name, bytes);
  }
  write_table_seeds(root);
  write_scene_seeds(root);
  write_jpegs(root / "jpeg");
  write_pngs(root / "png");
  // The other half of the gain map's fuzzer: pictures one after the other.
  fs::copy(root / "jpeg" / "iso_one.jpg", root / "gain_map" / "iso_one.jpg",
           fs::copy_options::overwrite_existing);
}

}  // namespace welkin::fuzz
