#pragma once

#include "welkin/brdf/brdf.h"

/// What AnyBrdf forwards to. Internal to brdf.
namespace welkin::brdf {

class AnyBrdf::Model {
 public:
  virtual ~Model() = default;
  virtual std::string name() const = 0;
  virtual std::string description() const = 0;
  virtual std::string source() const = 0;
  /// What stands behind the name in the spec, where that isn't the parameters.
  virtual std::string origin() const { return {}; }
  virtual std::vector<Parameter> parameters() const { return {}; }
  /// The same model with one of the parameters changed.
  virtual std::shared_ptr<const Model> with(std::string_view, double) const { return nullptr; }
  virtual std::vector<std::string> notes() const { return {}; }
  virtual bool mirror() const { return false; }
  /// Both directions are above the surface.
  virtual double value(const Vec3d& view, const Vec3d& light) const = 0;
  virtual double width() const = 0;
};

}  // namespace welkin::brdf
