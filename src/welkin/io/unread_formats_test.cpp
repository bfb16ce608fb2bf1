#include "welkin/io/unread_formats.h"

#include <bit>

#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

using namespace std::string_literals;

void put(std::string& text, std::size_t bytes, std::uint32_t value, bool big = false) {
  for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * (big ? bytes - 1 - i : i));
}

/// A directory of TIFF with entries {tag, value} of one LONG each, at `at`.
std::string directory(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& entries, bool big = false) {
  std::string text;
  put(text, 2, static_cast<std::uint32_t>(entries.size()), big);
  for (const auto& [tag, value] : entries) {
    put(text, 2, tag, big);
    put(text, 2, 4, big);
    put(text, 4, 1, big);
    put(text, 4, value, big);
  }
  put(text, 4, 0, big);
  return text;
}

std::string tiff_header(bool big = false) {
  std::string text = big ? "MM\0*"s : "II*\0"s;
  put(text, 4, 8, big);
  return text;
}

std::string tga(int type, int width, int height, int bits) {
  std::string text("\0\0\0\0\0\0\0\0\0\0\0\0", 12);
  text[2] = static_cast<char>(type);
  put(text, 2, static_cast<std::uint32_t>(width));
  put(text, 2, static_cast<std::uint32_t>(height));
  put(text, 2, static_cast<std::uint32_t>(bits));
  return text + std::string(static_cast<std::size_t>(width * height * bits / 8), '\7');
}

std::string message_of(const std::string& bytes) {
  return error_of([&] { open(bytes_of(bytes), "a.file"); });
}

TEST(UnreadFormats, AreNamedWithWhatConvertsThem) {
  struct Case {
    std::string bytes, name, remedy;
  };
  const std::string rest(200, '\5');
  const std::vector<Case> cases = {
      {"8BPS\0\1"s + rest, "(PSD)", "save it as EXR"},
      {"8BPS\0\2"s + rest, "(PSB)", "save it as EXR"},
      {"BM\x36\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0"s + rest, "BMP", "magick"},
      {"GIF89a" + rest, "GIF", "magick"},
      {"\x53\x80\xf6\x34" + rest, "Softimage", "magick"},
      {tga(2, 4, 3, 24), "TGA", "magick"},
      {tga(10, 4, 3, 32), "TGA", "magick"},
      {rest + "TRUEVISION-XFILE.\0"s, "TGA", "magick"},
      {"P1\n1 1\n0\n", "PNM", "magick"},
      {"P6\n1 1\n255\nabc", "PNM", "magick"},
      {"P7\nWIDTH 1\n", "PAM", "magick"},
      {"PH\n1 1\n-1\nabcdef", "PHM", "PFM"},
      {"II*\0\x10\0\0\0CR\2\0"s + rest, "(CR2)", "darktable-cli"},
      {tiff_header() + directory({{50706, 1}}) + rest, "(DNG)", "darktable-cli"},
      {tiff_header(true) + directory({{254, 1}, {330, 8 + 2 + 24 + 4}}, true) +
           directory({{262, 32803}}, true),
       "(NEF", "darktable-cli"},
      {tiff_header() + directory({{262, 34892}}) + rest, "raw file", "darktable-cli"},
      {"IIRO" + rest, "(ORF)", "darktable-cli"},
      {"\0\0\0\x18"
       "ftypcrx "s +
           rest,
       "(CR3)", "darktable-cli"},
      {"<?xml version='1.0'?>\n<svg/>", "SVG", "rsvg-convert"},
      {"  <SVG xmlns=''/>", "XML", "servers"},
      {"<svg xmlns=''/>", "SVG", "rsvg-convert"},
      {"<?xml version='1.0'?>\n<Error/>", "XML", "servers"},
      {"PK\3\4" + rest, "ZIP", "unpack it"},
      {"{\"asset\":{\"version\":\"2.0\"}}", "glTF", "environment"},
      {"{\"error\":404}", "JSON", "servers"},
      {"\0\0\0\x18"
       "ftypisom"s +
           rest,
       "MP4", "ffmpeg"},
      {"\0\0\0\x18"
       "ftypqt  "s +
           rest,
       "QuickTime", "ffmpeg"},
      {"\x1a\x45\xdf\xa3" + rest, "WebM", "ffmpeg"},
      {"RIFF\1\1\1\1AVI LIST" + rest, "AVI", "ffmpeg"},
      {"\n<!DOCTYPE html><title>404</title>", "HTML", "download the picture itself"},
      {"\xef\xbb\xbf<html>", "HTML", "download the picture itself"},
      {"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 12\n", "Git LFS", "git lfs pull"},
      {"sB\x13\0\x4d\0"s + rest, "Basis", "basisu -unpack"},
      {"404 Not Found. See https://example.org", "'404 Not Found.", "see what it says"},
      {std::string(5000, '\0'), "nothing but zeros", "fetch the file again"},
      {"#!/bin/sh\necho not a picture\n", "a text ('#!/bin/sh')", "see what it says"},
  };
  for (const Case& each : cases) {
    const std::string message = message_of(each.bytes);
    EXPECT_TRUE(message.starts_with("a.file: ")) << message;
    EXPECT_NE(message.find(each.name), std::string::npos) << message;
    EXPECT_NE(message.find(each.remedy), std::string::npos) << message;
  }
}

TEST(UnreadFormats, OtherBytesAreNotNamed) {
  const std::string rest(200, '\5');
  for (const std::string& bytes :
       {"BM"s, "BMxxxxxxxxxxxxxxxxxxx"s + rest, tga(2, 4, 3, 24).substr(0, 30), tga(2, 0, 3, 24),
        tga(4, 4, 3, 24), tga(2, 4, 3, 25), "P8\n1 1\n" + rest, "\1"s, "ab"s, "sB" + rest})
    EXPECT_NE(message_of(bytes).find("not an image of a known format"), std::string::npos) << bytes;
}

TEST(UnreadFormats, EveryBeginningIsSurvived) {
  for (const std::string& whole :
       {tga(2, 4, 3, 24), tga(1, 4, 3, 8),
        tiff_header() + directory({{330, 38}, {50706, 1}}) + directory({{262, 32803}}),
        tiff_header(true) + directory({{330, 0xffffffff}, {262, 32803}}, true)}) {
    for (std::size_t size = 1; size <= whole.size(); ++size) {
      const Bytes bytes = bytes_of(whole.substr(0, size));
      unread_format(bytes);
      camera_raw(bytes);
    }
    expect_damage_is_survived(bytes_of(whole));
  }
}

// A page of pictures with reduced copies, as microscopes and viewers write, is no camera's raw file.
TEST(UnreadFormats, DirectoriesBelowOthersAreNoRawFiles) {
  EXPECT_FALSE(
      camera_raw(bytes_of(tiff_header() + directory({{254, 0}, {330, 38}}) + directory({{262, 2}}))));
}

}  // namespace
}  // namespace welkin::io::test
