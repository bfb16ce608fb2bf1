#include "welkin/io/colour/icc_profile.h"

#include <lcms2.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "welkin/io/test_readers.h"

namespace welkin::io::test {
namespace {

using Pipeline = std::unique_ptr<cmsPipeline, decltype(&cmsPipelineFree)>;

Pipeline pipeline_of(const std::vector<cmsStage*>& stages) {
  Pipeline pipeline(cmsPipelineAlloc(nullptr, 3, 3), cmsPipelineFree);
  for (cmsStage* const stage : stages) EXPECT_NE(cmsPipelineInsertStage(pipeline.get(), cmsAT_END, stage), 0);
  return pipeline;
}

cmsStage* matrix_stage(double scale) {
  const double matrix[9] = {scale, 0, 0, 0, scale, 0, 0, 0, scale};
  return cmsStageAllocMatrix(nullptr, 3, 3, matrix, nullptr);
}

/// A table of 2³ colours, all alike.
cmsStage* table_stage() {
  const std::vector<cmsUInt16Number> table(24, 40000);
  return cmsStageAllocCLut16bit(nullptr, 2, 3, 3, table.data());
}

/// A profile whose values become colours by these stages.
Bytes profile_with(const std::vector<cmsTagSignature>& tags, const Pipeline& pipeline) {
  const cmsHPROFILE profile = cmsCreateProfilePlaceholder(nullptr);
  cmsSetProfileVersion(profile, 4.3);
  cmsSetDeviceClass(profile, cmsSigDisplayClass);
  cmsSetColorSpace(profile, cmsSigRgbData);
  cmsSetPCS(profile, cmsSigXYZData);
  for (const cmsTagSignature tag : tags) EXPECT_NE(cmsWriteTag(profile, tag, pipeline.get()), 0);
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  Bytes bytes(size);
  cmsSaveProfileToMem(profile, bytes.data(), &size);
  cmsCloseProfile(profile);
  return bytes;
}

ErrorKind kind_of_refusal(const Bytes& bytes) {
  try {
    const IccProfile profile(bytes);
  } catch (const Error& error) {
    return error.kind();
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorKind::bad_request;
}

TEST(IccProfile, NumbersThatMakeNoColoursAreRefused) {
  for (const double scale : {1e30, std::numeric_limits<double>::quiet_NaN()}) {
    const Bytes bytes = profile_with(
        {cmsSigDToB1Tag}, pipeline_of({matrix_stage(scale), matrix_stage(scale), matrix_stage(scale)}));
    EXPECT_EQ(kind_of_refusal(bytes), ErrorKind::damaged) << scale;
  }
}

TEST(IccProfile, EndlessStepsAreRefused) {
  for (const int count : {1024, 1025}) {
    std::vector<cmsStage*> stages;
    for (int i = 0; i < count; ++i) stages.push_back(matrix_stage(1));
    const Bytes bytes = profile_with({cmsSigDToB1Tag}, pipeline_of(stages));
    if (count == 1024)
      EXPECT_EQ(IccProfile(bytes).channels(), 3);
    else
      EXPECT_EQ(kind_of_refusal(bytes), ErrorKind::unsupported);
  }
}

/// A curve of that many pieces, each a straight line.
cmsToneCurve* curve_of(int pieces) {
  std::vector<cmsCurveSegment> segments(static_cast<std::size_t>(pieces));
  for (int i = 0; i < pieces; ++i) {
    cmsCurveSegment& segment = segments[static_cast<std::size_t>(i)];
    segment = {};
    segment.x0 = i == 0 ? -1e22f : static_cast<float>(i) / static_cast<float>(pieces);
    segment.x1 = i + 1 == pieces ? 1e22f : static_cast<float>(i + 1) / static_cast<float>(pieces);
    segment.Type = 6;
    segment.Params[0] = segment.Params[1] = 1;
  }
  return cmsBuildSegmentedToneCurve(nullptr, static_cast<cmsUInt32Number>(pieces), segments.data());
}

TEST(IccProfile, EndlessCurvesAreRefused) {
  // One step, three curves and their pieces.
  for (const int pieces : {340, 341}) {
    cmsToneCurve* const curve = curve_of(pieces);
    cmsToneCurve* curves[3] = {curve, curve, curve};
    const Bytes bytes =
        profile_with({cmsSigDToB1Tag}, pipeline_of({cmsStageAllocToneCurves(nullptr, 3, curves)}));
    cmsFreeToneCurve(curve);
    if (pieces == 340)
      EXPECT_EQ(IccProfile(bytes).channels(), 3);
    else
      EXPECT_EQ(kind_of_refusal(bytes), ErrorKind::unsupported);
  }
}

Pipeline table_pipeline() {
  return pipeline_of({cmsStageAllocToneCurves(nullptr, 3, nullptr), table_stage(),
                      cmsStageAllocToneCurves(nullptr, 3, nullptr), matrix_stage(1),
                      cmsStageAllocToneCurves(nullptr, 3, nullptr)});
}

TEST(IccProfile, TablesLargerThanTheFileAreRefused) {
  // The colours along each of up to sixteen sides; changed to 255³ colours.
  const Bytes sides = bytes_of(std::string("\2\2\2\0\0\0\0\0\0\0\0\0\0\0\0\0", 16));
  const auto enlarged = [&](Bytes bytes) {
    EXPECT_EQ(IccProfile(bytes).channels(), 3);
    const auto at = std::search(bytes.begin(), bytes.end(), sides.begin(), sides.end());
    EXPECT_NE(at, bytes.end());
    std::fill_n(at, 3, std::byte{255});
    return bytes;
  };
  // Of 6 bytes each: missed at the end of the file. Of 12: too much to begin with.
  EXPECT_EQ(kind_of_refusal(enlarged(profile_with({cmsSigAToB0Tag}, table_pipeline()))), ErrorKind::damaged);
  const std::vector<float> colours(24, 0.5f);
  const Bytes floats =
      profile_with({cmsSigDToB1Tag}, pipeline_of({cmsStageAllocCLutFloat(nullptr, 2, 3, 3, colours.data())}));
  EXPECT_EQ(kind_of_refusal(enlarged(floats)), ErrorKind::too_large);
}

TEST(IccProfile, OtherColourSpacesAreRefused) {
  for (const std::string space : {"CMYK", "Lab ", "\xfe\xff\xff\xff"}) {
    Bytes bytes = unusual_profile();
    const Bytes name = bytes_of(space);
    std::copy(name.begin(), name.end(), bytes.begin() + 16);
    EXPECT_EQ(kind_of_refusal(bytes), ErrorKind::unsupported) << space;
  }
}

TEST(IccProfile, NanStaysNan) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Bytes& bytes : {unusual_profile(), profile_with({cmsSigAToB0Tag}, table_pipeline())}) {
    const IccProfile profile(bytes);
    for (const bool keep_primaries : {false, true}) {
      Image picture(2, 1, 3);
      std::fill_n(picture.at(0, 0), 6, 0.5f);
      picture.at(1, 0)[1] = nan;
      profile.to_linear(picture.view(), 0, 1, 2, keep_primaries);
      for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(picture.at(0, 0)[c])) << c;
      EXPECT_TRUE(std::isnan(picture.at(1, 0)[1]));
    }
  }
}

TEST(IccProfile, ATableGoesBeforeAMatrix) {
  EXPECT_TRUE(IccProfile(unusual_profile()).has_primaries());
  EXPECT_FALSE(IccProfile(profile_with({cmsSigAToB0Tag}, table_pipeline())).has_primaries());
}

}  // namespace
}  // namespace welkin::io::test
