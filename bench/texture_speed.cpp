// Uncompressed textures: how long they take to write and to read, beside a copy of as many bytes by the
// system.
//
// texture_speed FOLDER     puts its files there and removes them.

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <vector>

#include "harness.h"
#include "pictures.h"
#include "welkin/io/image_file.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr int kWidth = 2048, kHeight = 1024;

/// Some bytes into a file.
void write_bytes(const std::filesystem::path& path, const std::vector<char>& bytes) {
  const int out = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  std::size_t done = 0;
  for (ssize_t got = 1; done < bytes.size() && got > 0;
       done += static_cast<std::size_t>(std::max<ssize_t>(got, 0)))
    got = write(out, bytes.data() + done, bytes.size() - done);
  if (out < 0 || close(out) != 0 || done != bytes.size()) std::perror("texture_speed");
}

void read_bytes(const std::filesystem::path& path, std::vector<char>& bytes) {
  const int in = open(path.c_str(), O_RDONLY);
  std::size_t done = 0;
  for (ssize_t got = 1; done < bytes.size() && got > 0;
       done += static_cast<std::size_t>(std::max<ssize_t>(got, 0)))
    got = read(in, bytes.data() + done, bytes.size() - done);
  if (in < 0 || close(in) != 0 || done != bytes.size()) std::perror("texture_speed");
}

std::string times(const Timing& ours, const Timing& theirs) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f × %.1f ms", ratio(ours, theirs), 1e3 * theirs.median().cpu);
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "texture_speed FOLDER\n"), 2;
  const Threads threads;
  const Map map = detailed_picture(kWidth);
  std::printf(
      "\n## Textures\n\nA picture of %d×%d without compression: CPU time over that of the system for the "
      "same bytes, in the "
      "same rounds. Floats in memory, R G B; files have A too.\n\n",
      kWidth, kHeight);
  const Table table({"file", "texels", "writing", "reading"});
  const ImageView<const float> picture = map.level.chart(0);
  Image again(kWidth, kHeight, 3);
  for (const char* extension : {"ktx2", "dds", "ktx"}) {
    for (const io::PixelType type : {io::PixelType::float32, io::PixelType::half}) {
      const std::filesystem::path path =
                                      std::filesystem::path(argv[1]) / ("picture." + std::string(extension)),
                                  copy = std::filesystem::path(argv[1]) / "copy";
      const io::WritePart part{"", picture, {"R", "G", "B"}};
      io::WriteOptions options;
      options.type = type;
      io::write(path, {&part, 1}, options);
      std::vector<char> bytes(std::filesystem::file_size(path));
      constexpr int kAll[] = {0, 1, 2};
      const auto timings =
          time_jobs({[&] {
                       io::write(path, {&part, 1}, options);
                     },
                     [&] { write_bytes(copy, bytes); }, [&] { io::open(path)->read(0, kAll, again.view()); },
                     [&] { read_bytes(path, bytes); }});
      table.row({extension, std::string(io::name_of(type)), times(timings[0], timings[1]),
                 times(timings[2], timings[3])});
      std::filesystem::remove(path);
      std::filesystem::remove(copy);
    }
  }
}
