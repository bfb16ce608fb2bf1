#include "welkin/light/importance_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "welkin/io/image_file.h"
#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

class ImportanceFile : public ::testing::Test {
 protected:
  ImportanceFile() { std::filesystem::create_directory(folder); }
  ~ImportanceFile() override { std::filesystem::remove_all(folder); }

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() /
      ("welkin_importance_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
};

Image read(const std::filesystem::path& path) {
  const auto reader = io::open(path, {.colour = io::Colour::linear});
  const io::PartInfo& part = reader->info().parts.at(0);
  std::vector<int> channels;
  for (std::size_t c = 0; c < part.channels.size(); ++c) channels.push_back(static_cast<int>(c));
  Image image(part.width, part.height, static_cast<int>(channels.size()));
  reader->read(0, channels, image.view());
  return image;
}

Map some_map(const std::string& spec) {
  return cases::rendered(spec, 10, [](const Vec3d& d) { return d.y > 0.2 ? std::exp(3 * d.x) : 0.0; });
}

/// What a renderer does with the file: a row, a column, density. The texel's probability follows.
TEST_F(ImportanceFile, CdfIsThatOfTheSampler) {
  for (const char* spec : {"latlong", "cube", "paraboloid"}) {
    for (const char* extension : {"exr", "ktx2"}) {
      const ImportanceSampler sampler(some_map(spec));
      const auto paths = write_importance(folder / (std::string("sky.") + extension), sampler);
      ASSERT_EQ(paths.size(), 3u);
      const Image table = read(paths[0]), rows = read(paths[1]);
      const ChartSize size = sampler.frame().size;
      ASSERT_EQ(table.width(), size.width);
      ASSERT_EQ(table.height(), size.height * sampler.frame().parameterization.charts());
      ASSERT_EQ(rows.height(), table.height());
      ASSERT_EQ(rows.width(), 1);
      double integral = 0;
      for (int row = 0; row < table.height(); ++row) {
        const double above = row == 0 ? 0 : static_cast<double>(*rows.at(0, row - 1));
        const std::vector<double> areas = sampler.valid_areas(row);
        for (int x = 0; x < table.width(); ++x) {
          const double left = x == 0 ? 0 : static_cast<double>(*table.at(x - 1, row));
          const double p = (static_cast<double>(*rows.at(0, row)) - above) *
                           (static_cast<double>(*table.at(x, row)) - left);
          // Floats: 6e-8 of the sums.
          EXPECT_NEAR(p, sampler.probability(row / size.height, x, row % size.height), 2e-7);
          const double density = static_cast<double>(table.at(x, row)[1]);
          EXPECT_NEAR(density * areas[static_cast<std::size_t>(x)] / (size.width * size.height), p, 1e-6 * p);
          integral += density * areas[static_cast<std::size_t>(x)] / (size.width * size.height);
        }
      }
      EXPECT_NEAR(integral, 1, 1e-5);
    }
  }
}

TEST_F(ImportanceFile, AliasIsThatOfTheSampler) {
  for (const char* extension : {"exr", "ktx2"}) {
    const ImportanceSampler sampler(some_map("octahedral"), {.method = ImportanceMethod::alias});
    const auto paths = write_importance(folder / (std::string("sky.") + extension), sampler);
    ASSERT_EQ(paths.size(), 2u);
    const Image table = read(paths[0]);
    std::vector<double> own(static_cast<std::size_t>(table.width() * table.height()));
    const bool exr = extension == std::string("exr");
    // EXR sorts channels by name: alias_row, alias_x, density, threshold.
    const int threshold = exr ? 3 : 0, column = 1, row_of = exr ? 0 : 2;
    for (int y = 0; y < table.height(); ++y) {
      for (int x = 0; x < table.width(); ++x) {
        const float* texel = table.at(x, y);
        own[static_cast<std::size_t>(y * table.width() + x)] += static_cast<double>(texel[threshold]);
        own[static_cast<std::size_t>(static_cast<int>(texel[row_of]) * table.width() +
                                     static_cast<int>(texel[column]))] +=
            1 - static_cast<double>(texel[threshold]);
      }
    }
    for (std::size_t i = 0; i < own.size(); ++i) {
      EXPECT_NEAR(
          own[i] / static_cast<double>(own.size()),
          sampler.probability(0, static_cast<int>(i) % table.width(), static_cast<int>(i) / table.width()),
          1e-7);
    }
  }
}

TEST_F(ImportanceFile, HeaderSaysWhatTheTablesAre) {
  const ImportanceSampler sampler(some_map("cube"), {.compensate = true});
  const auto paths = write_importance(folder / "a \"sky\".exr", sampler);
  std::ifstream file(paths.back());
  std::stringstream text;
  text << file.rdbuf();
  for (const char* part :
       {"\"method\": \"cdf\"", "\"compensated\": true", "\"parameterization\": \"cube\"", "\"charts\": 6",
        "a \\\"sky\\\"_rows.exr", "\"orientation\": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]"})
    EXPECT_NE(text.str().find(part), std::string::npos) << part << text.str();
}

TEST_F(ImportanceFile, OtherFormatsAreRefusedAndLeaveNothing) {
  const ImportanceSampler sampler(some_map("latlong"));
  EXPECT_NE(cases::refusal([&] { write_importance(folder / "sky.png", sampler); }).find("EXR or KTX2"),
            std::string::npos);
  EXPECT_NE(cases::refusal([&] { write_importance(folder / "none" / "sky.exr", sampler); }).find("sky"),
            std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

/// Valid areas of a disc: together the disc's.
TEST_F(ImportanceFile, ValidAreasMakeADisc) {
  const ImportanceSampler sampler(some_map("angular"));
  double area = 0;
  for (int row = 0; row < sampler.frame().size.height; ++row) {
    for (const double each : sampler.valid_areas(row)) area += each;
  }
  const ChartSize size = sampler.frame().size;
  EXPECT_NEAR(area / (size.width * size.height), kPi / 4, 1e-4);
}

}  // namespace
}  // namespace welkin
