#pragma once

/// @file
/// How long encoders of compressed textures search.
namespace welkin {

/// How long an encoder of compressed textures searches for the best blocks (docs/benchmarks.md has the
/// errors).
enum class TextureQuality {
  fast,    ///< for previews: about half the time of `normal`
  normal,  ///< close to the best
  best,    ///< about two to three times the time of `normal`
};

}  // namespace welkin
