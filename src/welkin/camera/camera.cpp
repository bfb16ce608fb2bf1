#include "welkin/camera/camera.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/base/parameter.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

/// A lens by another name.
struct Mounted {
  const char* name;
  const char* description;
  const char* lens;
  bool disc;                ///< its picture is a disc, whose rim is its field of view
  double fov, least, most;  ///< by default, and what there is, degrees
  double pitch;             ///< of the lens on the camera
  double tilt;              ///< of the dome, which lowers its front, by default
};

constexpr std::array kMounted{
    Mounted{"dome", "a planetarium's dome, front at the bottom, fov 180 to 360; tilt lowers the front",
            "equidistant", true, 180, 1, 360, 90, 0},
    Mounted{"little-planet", "the ground as a ball with the sky around it, fov to 359", "stereographic",
            false, 270, 0.1, 359, -90, 0},
};

std::string name_in(std::string_view lens) {
  return std::string(lens.substr(0, lens.find(',')));
}

/// What is left of `lens` without the assignment `NAME=NUMBER`, which is returned in `value`.
std::string take(std::string lens, const Parameter& parameter, double& value) {
  const std::size_t at = lens.find("," + parameter.name + "=");
  if (at == std::string::npos) return lens;
  const std::size_t end = std::min(lens.find(',', at + 1), lens.size());
  value =
      parse_parameter(name_in(lens), {parameter}, std::string_view(lens).substr(at + 1, end - at - 1)).value;
  return lens.erase(at, end - at);
}

bool assigns(std::string_view lens, std::string_view parameter) {
  return lens.find("," + std::string(parameter) + "=") != std::string_view::npos;
}

bool takes(const AnyParameterization& p, std::string_view parameter) {
  const std::vector<Parameter> all = p.parameters();
  return std::any_of(all.begin(), all.end(), [&](const Parameter& each) { return each.name == parameter; });
}

std::string assignment(std::string_view name, double value) {
  return "," + std::string(name) + "=" + number_text(value);
}

/// A part of a lat-long that is `fov` across or down.
std::string window(const Camera& camera, const std::string& lens) {
  const double aspect = static_cast<double>(camera.size.width) / camera.size.height;
  if (camera.axis == FovAxis::diagonal)
    throw Error(ErrorKind::bad_request, "latlong has no diagonal field of view; say how wide or high it is");
  const double width = camera.axis == FovAxis::horizontal ? *camera.fov : *camera.fov * aspect;
  const double height = width / aspect;
  const Parameter range{"fov", 0, 0.1, camera.axis == FovAxis::horizontal ? 360.0 : 180.0, ""};
  check_range("latlong", range, *camera.fov, number_text(*camera.fov));
  if (!(width <= 360 && height <= 180))
    throw Error(ErrorKind::bad_request, "latlong: a picture of this aspect would show " + number_text(width) +
                                            "° by " + number_text(height) + "°, and there are 360° by 180°");
  const double across = width * camera.shift_right, up = height * camera.shift_up;
  if (std::fabs(up) + 0.5 * height > 90)
    throw Error(ErrorKind::bad_request, "latlong: shifted up or down so far, the picture goes past a pole");
  return lens + assignment("left", across - 0.5 * width) + assignment("right", across + 0.5 * width) +
         assignment("top", up + 0.5 * height) + assignment("bottom", up - 0.5 * height);
}

/// The lens with the camera's field of view and shift.
std::string with_view(const Camera& camera, std::string lens) {
  const auto plain = AnyParameterization::make(lens);
  const std::string name = name_in(lens);
  const bool frame = plain.traits().follows_aspect;
  if (camera.fov) {
    for (const char* each : {"fov", "vfov", "dfov", "left", "right", "top", "bottom"}) {
      if (assigns(lens, each) && (each[0] != 'r' || !frame))
        throw Error(ErrorKind::bad_request,
                    "the field of view is given twice: as " + number_text(*camera.fov) + " and in " + lens);
    }
    if (name == "latlong") return window(camera, std::move(lens));
    const char* parameter = !frame || camera.axis == FovAxis::horizontal ? "fov"
                            : camera.axis == FovAxis::vertical           ? "vfov"
                                                                         : "dfov";
    if (!takes(plain, parameter))
      throw Error(ErrorKind::bad_request, name + " has no field of view to choose");
    // 0 stands for none.
    if (!(*camera.fov > 0))
      check_range(name, {"fov", 0, 0.1, 360, ""}, *camera.fov, number_text(*camera.fov));
    lens += assignment(parameter, *camera.fov);
  }
  if (camera.shift_right == 0 && camera.shift_up == 0) return lens;
  if (!frame)
    throw Error(ErrorKind::bad_request,
                name + (name == "latlong" && !camera.fov ? " is shifted when its field of view is given"
                                                         : " has no frame to shift"));
  if (assigns(lens, "right") || assigns(lens, "up"))
    throw Error(ErrorKind::bad_request, "the shift is given twice: also in " + lens);
  return lens + assignment("right", camera.shift_right) + assignment("up", camera.shift_up);
}

/// Of a mounted lens: its spec, with the pitch of the mount.
std::string unmounted(const Mounted& mounted, Camera& camera, double& pitch) {
  std::string rest = camera.lens.substr(std::string_view(mounted.name).size());
  double fov = mounted.fov, tilt = mounted.tilt;
  if (mounted.disc) {
    const Parameter of_tilt{"tilt", 0, -90, 90, ""};
    rest = take(mounted.name + rest, of_tilt, tilt).substr(std::string_view(mounted.name).size());
    const Parameter of_fov{"fov", 0, mounted.least, mounted.most, ""};
    rest = take(mounted.name + rest, of_fov, fov).substr(std::string_view(mounted.name).size());
    if (camera.fov) {
      check_range(mounted.name, of_fov, *camera.fov, number_text(*camera.fov));
      fov = *camera.fov;
    }
    // The disc fills the shorter side.
    camera.fov = fov;
    camera.axis = camera.size.width < camera.size.height ? FovAxis::horizontal : FovAxis::vertical;
    rest += assignment("rim", fov);
  } else if (!camera.fov && !assigns(rest, "fov") && !assigns(rest, "vfov") && !assigns(rest, "dfov")) {
    camera.fov = fov;
  }
  pitch = mounted.pitch - tilt;
  return mounted.lens + rest;
}

}  // namespace

FovAxis fov_axis_from_name(std::string_view name) {
  const std::vector<std::string> names{"horizontal", "vertical", "diagonal"};
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    throw Error(ErrorKind::bad_request, unknown_name("axis of a field of view", name, names));
  return static_cast<FovAxis>(at - names.begin());
}

std::vector<CameraName> camera_names() {
  std::vector<CameraName> names;
  for (const Mounted& each : kMounted) names.push_back({each.name, each.description});
  return names;
}

MapFrame frame_of(const Camera& camera) {
  require(camera.size.width >= 1 && camera.size.height >= 1, "a picture has at least one pixel");
  require(is_orthonormal(camera.rotation) && determinant(camera.rotation) > 0,
          "a camera is turned by a rotation");
  for (const double value : {camera.fov.value_or(1), camera.shift_right, camera.shift_up})
    require(std::isfinite(value), "a camera's field of view and shift are numbers");
  const std::string name = name_in(camera.lens);
  const auto mounted =
      std::find_if(kMounted.begin(), kMounted.end(), [&](const Mounted& each) { return name == each.name; });
  Camera aimed = camera;
  std::string lens = camera.lens;
  double pitch = 0;
  if (mounted != kMounted.end()) {
    lens = unmounted(*mounted, aimed, pitch);
  } else {
    const std::vector<std::string> known = sphere::parameterization_names();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      std::vector<std::string> names = known;
      for (const Mounted& each : kMounted) names.emplace_back(each.name);
      throw Error(ErrorKind::bad_request, unknown_name("camera", name, names));
    }
  }
  const auto parameterization = AnyParameterization::make(with_view(aimed, lens));
  require(parameterization.charts() == 1, "a camera's picture is one chart, and this one has several");
  const Matrix3 rotation = camera.rotation * rotation_of({0, pitch, 0});
  return {parameterization, camera.size, transpose(rotation)};
}

}  // namespace welkin
