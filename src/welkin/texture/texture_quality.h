#pragma once

/// @file
/// How long encoders of compressed textures search.
namespace welkin {

/// How long an encoder of compressed textures searches for the best blocks (docs/textures.md has the errors).
enum class TextureQuality {
  fast,    ///< for previews: about a third of the time of `normal`
  normal,  ///< close to the best
  best,    ///< about twice the time of `normal`
};

}  // namespace welkin
