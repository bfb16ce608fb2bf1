#pragma once

#include <span>
#include <vector>

#include "welkin/image/image.h"
#include "welkin/io/exr/header.h"

/// What EXR files say of colour, and luminance with chroma at the full resolution.
namespace welkin::io::exr {

/// Fills in what the parts say of their primaries and their transfer function, by `chromaticities` or,
/// without these, by names of the Color Interop Forum (`colorInteropID`, "Identifying Color Spaces in
/// OpenEXR"). Warns in a part's warnings of what is said and can't be declared; of parts that differ, all but
/// BT.709.
void declare_colour(std::vector<Part>& parts, Declared& declared);

/// Y RY BY (A) of the part as R G B (A) (Technical Introduction to OpenEXR, "Luminance/Chroma Images"):
/// RY = (R − Y)/Y, BY = (B − Y)/Y, and Y is the luminance of the part's primaries. `channels` of each texel
/// of `out` are numbers in the order R G B A.
void convert_chroma(const Part& part, ImageView<const float> stored, std::span<const int> channels,
                    ImageView<float> out);

}  // namespace welkin::io::exr
