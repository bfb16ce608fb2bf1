#include <fmt/core.h>

#include <memory>

#include "command.h"
#include "picture_file.h"
#include "welkin/brdf/roughness_mips.h"
#include "welkin/io/image_file.h"

namespace welkin::cli {
namespace {

struct Roughness {
  std::string normals, roughness, out, format;
  bool flip_green = false;
  double scale = 1;
  int levels = 0;
  WriteFlags write;

  void run() const;
};

void Roughness::run() const {
  check_extension(out);
  if (!io::capabilities_for(out).levels && levels != 1)
    throw UsageError(out + ": the format has no levels; write KTX2, or EXR, or --levels 1");
  const Image normal_map = read_picture(normals, 3, io::Colour::linear);
  Image rough;
  // A number stands for a map of one value.
  char* end = nullptr;
  const double number = std::strtod(roughness.c_str(), &end);
  if (!roughness.empty() && *end == '\0') {
    rough = Image(1, 1, 1);
    *rough.at(0, 0) = static_cast<float>(number);
  } else {
    rough = read_picture(roughness, 1, io::Colour::linear);
  }
  std::vector<Image> made;
  try {
    made = brdf::roughness_mips(normal_map.view(), rough.view(),
                                {.normal_scale = scale, .flip_green = flip_green, .levels = levels});
  } catch (const Error& error) {
    throw in_file(normals, error);
  }
  std::vector<io::WritePart> parts;
  for (std::size_t k = 0; k < made.size(); ++k) {
    io::WritePart part;
    part.image = made[k].view();
    part.channels = {"Y"};
    part.level = static_cast<int>(k);
    parts.push_back(std::move(part));
  }
  WriteMapOptions how = write.parse();
  if (how.image.colour == io::Colour::automatic) how.image.colour = io::Colour::linear;
  report_losses(out, io::write(out, parts, how.image));
  fmt::print("{} levels, of {}×{} texels; roughness of the last {:.3f}\n", made.size(), made[0].width(),
             made[0].height(), *made.back().at(0, 0));
}

}  // namespace

void add_roughness(Command app) {
  auto roughness = std::make_shared<Roughness>();
  Command command = app.add_command(
      "roughness", "Make the levels of a roughness map, rougher where a normal map's levels lose its bumps");
  command.add_option("NORMALS", roughness->normals, "Normal map, R G B = (n + 1)/2").required();
  command
      .add_option("ROUGHNESS", roughness->roughness, "Roughness map of the same size, or a number of 0 to 1")
      .required();
  command.add_option("OUT", roughness->out, "KTX2 or EXR to write, with levels").required();
  command.add_option("--scale", roughness->scale, "Of the normals' x and y, as the material has it")
      .finite(0)
      .show_default();
  command.add_flag("--flip-green", roughness->flip_green, "The normal map's green goes down (DirectX)");
  command.add_option("--levels", roughness->levels, "How many. Default: down to one texel").within(1, 31);
  roughness->write.add(command);
  add_format(command, roughness->format);
  command.callback([roughness] {
    roughness->out = output_path(roughness->out, roughness->format);
    roughness->normals = input_path(roughness->normals);
    roughness->run();
  });
}

}  // namespace welkin::cli
