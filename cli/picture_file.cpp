#include "picture_file.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "progress.h"
#include "welkin/io/image_file.h"
#include "welkin/sequence/made_note.h"

namespace welkin::cli {

Image read_picture(const std::string& file, int most, io::Colour colour) {
  const std::unique_ptr<io::Reader> reader = io::open(std::filesystem::path(file), {.colour = colour});
  const io::PartInfo& part = reader->info().parts.at(0);
  std::vector<int> channels;
  for (int c = 0; c < most && c < static_cast<int>(part.channels.size()); ++c) channels.push_back(c);
  Image image(part.width, part.height, static_cast<int>(channels.size()));
  reader->read(0, channels, image.view());
  return image;
}

void write_picture(const std::string& file, const Image& picture, bool opaque, const WriteFlags& flags,
                   const std::string& note) {
  std::vector<std::string> channels{"R", "G", "B", "A"};
  WriteMapOptions how = flags.parse();
  if (!note.empty()) how.image.attributes[sequence::kFrameKey] = note;
  Image coloured;
  ImageView<const float> shown = picture.view();
  if (opaque || io::capabilities_for(file).channels == io::Channels::rgb) {
    coloured = Image(picture.width(), picture.height(), 3);
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) std::copy_n(picture.at(x, y), 3, coloured.at(x, y));
    shown = coloured.view();
    channels.pop_back();
    if (!opaque) print_warning(file, "the format has no alpha: what is not covered is black");
  }
  const io::WritePart part{.name = {}, .image = shown, .channels = channels};
  report_losses(file, io::write(file, {&part, 1}, how.image));
}

}  // namespace welkin::cli
