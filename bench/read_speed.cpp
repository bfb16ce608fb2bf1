// How long files take to read, beside OpenEXR's own library in the same process.
//
// read_speed FOLDER     puts its files there and removes them.

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfThreading.h>

#include <cstring>
#include <filesystem>

#include "harness.h"
#include "pictures.h"
#include "welkin/io/image_file.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr int kWidth = 4096, kHeight = 2048;

Image make_picture() {
  const Map map = detailed_picture(kWidth);
  Image picture(kWidth, kHeight, 3);
  copy_pixels(map.level.chart(0), picture.view());
  return picture;
}

void read_with_welkin(const std::filesystem::path& path, Image& to) {
  constexpr int kAll[] = {0, 1, 2};
  io::open(path)->read(0, kAll, to.view());
}

/// R, G and B into interleaved floats: the same result as above.
void read_with_openexr(const std::filesystem::path& path, Image& to) {
  Imf::InputFile file(path.c_str());
  const auto box = file.header().dataWindow();
  Imf::FrameBuffer pixels;
  const char* names[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    pixels.insert(names[c], Imf::Slice::Make(Imf::FLOAT, to.at(0, 0) + c, box, 3 * sizeof(float),
                                             3 * sizeof(float) * static_cast<std::size_t>(kWidth)));
  }
  file.setFrameBuffer(pixels);
  file.readPixels(box.min.y, box.max.y);
}

struct Case {
  const char* name;
  const char* file;
  io::PixelType type;
  const char* compression;
};

void run_case(const Case& each, const std::filesystem::path& folder, const Image& picture,
              const Table& table) {
  const std::filesystem::path path = folder / each.file;
  const io::WritePart part{"", picture.view(), {"R", "G", "B"}};
  io::WriteOptions options;
  options.type = each.type;
  options.compression = each.compression;
  const bool is_exr = path.extension() == ".exr";
  io::write(path, std::span(&part, 1), is_exr ? options : io::WriteOptions{});

  Image ours(kWidth, kHeight, 3), theirs(kWidth, kHeight, 3), copy(kWidth, kHeight, 3);
  std::vector<std::function<void()>> jobs{
      [&] { read_with_welkin(path, ours); },
      [&] { std::memcpy(copy.at(0, 0), ours.at(0, 0), sizeof(float) * 3 * kWidth * kHeight); }};
  if (is_exr) jobs.push_back([&] { read_with_openexr(path, theirs); });
  const auto timings = time_jobs(jobs);
  const auto megabytes = static_cast<double>(std::filesystem::file_size(path)) * 1e-6;
  std::filesystem::remove(path);
  std::string same = "";
  if (is_exr) {
    same = std::memcmp(ours.at(0, 0), theirs.at(0, 0), sizeof(float) * 3 * kWidth * kHeight) == 0 ? "yes"
                                                                                                  : "**no**";
  }
  table.row({each.name, fixed(megabytes, 0), cpu_cell(timings[0]), wall_cell(timings[0]),
             fixed(ratio(timings[0], timings[1]), 1), is_exr ? cpu_cell(timings[2]) : "",
             is_exr ? wall_cell(timings[2]) : "",
             is_exr ? fixed(ratio(timings[2], timings[0]), 2) + " ×" : "", same});
}

}  // namespace

int main(int argc, char** argv) {
  const Threads threads;
  const std::filesystem::path folder = argc > 1 ? argv[1] : std::filesystem::temp_directory_path().c_str();
  heading("Reading 4096×2048 RGB into floats");
  paragraph(
      "Files lie in the page cache. The peer is OpenEXR's C++ library (`Imf::InputFile`), with as many "
      "threads, in the same "
      "process; the floor is one copy of the decoded floats. Ratios are of CPU time.");
  Imf::setGlobalThreadCount(threads.count());
  const Image picture = make_picture();
  const Table table({"file", "MB", "Welkin, CPU s", "wall s", "× the copy", "OpenEXR, CPU s", "wall s",
                     "OpenEXR / Welkin", "same bits"});
  constexpr auto kHalf = io::PixelType::half, kFloat = io::PixelType::float32;
  for (const Case& each :
       {Case{"EXR half, none", "half_none.exr", kHalf, "none"},
        Case{"EXR float, none", "float_none.exr", kFloat, "none"},
        Case{"EXR half, ZIP", "half_zip.exr", kHalf, "zip"},
        Case{"EXR float, ZIP", "float_zip.exr", kFloat, "zip"},
        Case{"EXR half, PIZ", "half_piz.exr", kHalf, "piz"}, Case{"HDR (RGBE)", "rgbe.hdr", kFloat, ""},
        Case{"PFM", "float.pfm", kFloat, ""}}) {
    run_case(each, folder, picture, table);
  }
}
