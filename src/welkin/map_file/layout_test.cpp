#include "welkin/map_file/layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "welkin/base/error.h"
#include "welkin/synth/synth.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

/// The direction seen at (x, y) ∈ [0,1]² of a cell's picture.
Vec3d direction_in(const AnyParameterization& p, const LayoutCell& cell, double x, double y) {
  for (int i = 0; i < cell.quarter_turns; ++i) {
    const double before = x;
    x = y;
    y = 1 - before;
  }
  if (cell.mirrored) x = 1 - x;
  return p.to_sphere(cell.chart, x, y);
}

bool faces_adjoin(const std::string& name) {
  return name == "hcross" || name == "vcross" || name == "flat";
}

TEST(Layout, CrossesJoinAtEveryInnerEdge) {
  const auto cube = AnyParameterization::make("cube");
  int checked = 0;
  for (const Layout& original : layouts_of(cube)) {
    if (!faces_adjoin(original.name)) continue;
    for (const Layout& layout : {original, for_reflected_world(original, cube)}) {
      for (const LayoutCell& a : layout.cells) {
        for (const LayoutCell& b : layout.cells) {
          for (const double t : {0.1, 0.5, 0.9}) {
            if (b.row == a.row && b.column == a.column + 1) {
              EXPECT_LT(length(direction_in(cube, a, 1, t) - direction_in(cube, b, 0, t)), 1e-12)
                  << layout.name;
              ++checked;
            }
            if (b.column == a.column && b.row == a.row + 1) {
              EXPECT_LT(length(direction_in(cube, a, t, 1) - direction_in(cube, b, t, 0)), 1e-12)
                  << layout.name;
              ++checked;
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(checked, 3 * 2 * 5 * 3);  // three layouts, both worlds, five inner edges, three points
}

TEST(Layout, BandsJoinWithinTheirRows) {
  const auto cube = AnyParameterization::make("eac");
  for (const Layout& layout : layouts_of(cube)) {
    if (layout.name != "bands") continue;
    for (const LayoutCell& a : layout.cells) {
      for (const LayoutCell& b : layout.cells) {
        if (b.row != a.row || b.column != a.column + 1) continue;
        EXPECT_LT(length(direction_in(cube, a, 1, 0.3) - direction_in(cube, b, 0, 0.3)), 1e-12);
      }
    }
    return;
  }
  FAIL() << "no bands";
}

/// Seen from inside, right × down points away from the eye: right × down · forward > 0 in a right-handed
/// world.
TEST(Layout, PicturesOfCubesAreNeverMirrored) {
  const auto cube = AnyParameterization::make("cube");
  for (const Layout& layout : layouts_of(cube)) {
    if (layout.kind == LayoutKind::layers) continue;
    for (const LayoutCell& cell : layout.cells) {
      const Vec3d middle = direction_in(cube, cell, 0.5, 0.5);
      const Vec3d right = direction_in(cube, cell, 0.6, 0.5) - middle;
      const Vec3d down = direction_in(cube, cell, 0.5, 0.6) - middle;
      EXPECT_GT(dot(cross(right, down), middle), 0) << layout.name << " face " << cell.chart;
    }
  }
}

/// The four pictures of OpenEXR's drawing (ImfEnvmap.h) that fix its orientation.
TEST(Layout, OpenExrStripFollowsItsHeader) {
  const auto cube = AnyParameterization::make("openexr-cube,width=8,height=8");
  const MapShape shape = parse_map_shape("openexr-cube:openexr");
  const auto towards = [&](int row, double x, double y) {
    for (const LayoutCell& cell : shape.layout.cells) {
      if (cell.row == row) return direction_in(cube, cell, x, y);
    }
    return Vec3d{};
  };
  EXPECT_GT(towards(0, 0.9, 0.5).z, 0.1);  // +X: Z at the right, Y on top
  EXPECT_GT(towards(0, 0.5, 0.1).y, 0.1);
  EXPECT_GT(towards(1, 0.1, 0.5).z, 0.1);  // −X: Z at the left
  EXPECT_GT(towards(2, 0.5, 0.1).z, 0.1);  // +Y: Z on top, X at the right
  EXPECT_GT(towards(2, 0.9, 0.5).x, 0.1);
  EXPECT_GT(towards(3, 0.5, 0.9).z, 0.1);  // −Y: Z at the bottom, X at the right
  EXPECT_GT(towards(3, 0.9, 0.5).x, 0.1);
  EXPECT_GT(towards(4, 0.1, 0.5).x, 0.1);  // +Z: X at the left
  EXPECT_GT(towards(5, 0.9, 0.5).x, 0.1);  // −Z: X at the right
}

TEST(Layout, EveryLayoutHasEveryChartOnceInACellOfItsOwn) {
  for (const std::string& name : sphere::parameterization_names()) {
    const auto p = AnyParameterization::make(name);
    for (const Layout& layout : layouts_of(p)) {
      std::set<int> charts;
      std::set<std::pair<int, int>> positions;
      for (const LayoutCell& cell : layout.cells) {
        charts.insert(cell.chart);
        positions.insert({cell.column, cell.row});
        EXPECT_LT(cell.column, layout.columns);
        EXPECT_LT(cell.row, layout.rows);
      }
      EXPECT_EQ(static_cast<int>(charts.size()), p.charts()) << name << ":" << layout.name;
      EXPECT_EQ(positions.size(), charts.size()) << name << ":" << layout.name;
    }
  }
}

TEST(Layout, CopyingToACellAndBackKeepsTheChart) {
  Image chart(5, 5, 2), picture(5, 5, 2), back(5, 5, 2);
  for (int i = 0; i < 50; ++i) chart.view().data[i] = static_cast<float>(i);
  for (const bool mirrored : {false, true}) {
    for (int turns = 0; turns < 4; ++turns) {
      const LayoutCell cell{0, 0, 0, turns, mirrored};
      copy_to_cell(cell, chart.view(), picture.view());
      copy_from_cell(cell, picture.view(), back.view());
      for (int i = 0; i < 50; ++i) EXPECT_EQ(back.view().data[i], chart.view().data[i]);
      // A clockwise turn brings the bottom left corner to the top left.
      if (turns == 1 && !mirrored) {
        EXPECT_EQ(picture.at(0, 0)[0], chart.at(0, 4)[0]);
      }
    }
  }
}

TEST(MapShape, ParsesAndPrintsTheSameText) {
  for (const char* text :
       {"latlong", "cube:vcross", "fisheye-equidistant,fov=200", "paraboloid:vstrip", "healpix:grid"}) {
    EXPECT_EQ(parse_map_shape(text).text(), text);
  }
  EXPECT_EQ(parse_map_shape("cube").text(), "cube:hcross");
}

std::string message_of(const char* text) {
  try {
    parse_map_shape(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "parsed";
}

TEST(MapShape, RefusesUnknownLayouts) {
  EXPECT_NE(message_of("cube:hcros").find("did you mean 'hcross'"), std::string::npos);
  EXPECT_NE(message_of("latlong:hcross").find("takes no layout"), std::string::npos);
}

TEST(Layout, FacesAreReorderedTurnedAndRefused) {
  const auto cube = AnyParameterization::make("cube");
  const Layout strip = parse_map_shape("cube:hstrip").layout;
  const Layout changed = with_faces(strip, cube, "+Z,nz,py:90,ny:270:mirror,px,nx");
  EXPECT_EQ(changed.cells[0].chart, 4);
  EXPECT_EQ(changed.cells[2].quarter_turns, 1);
  EXPECT_TRUE(changed.cells[2].mirrored);
  // Turned by 270°, then mirrored: a mirrored picture turned by 90°; its own mirroring cancels.
  EXPECT_EQ(changed.cells[3].quarter_turns, 1);
  EXPECT_FALSE(changed.cells[3].mirrored);
  for (const char* bad :
       {"px,nx,py,ny,pz", "px,px,py,ny,pz,nz", "px,nx,py,ny,pz,qq", "px:45,nx,py,ny,pz,nz"}) {
    EXPECT_THROW(with_faces(strip, cube, bad), Error) << bad;
  }
}

/// A chart whose every value says where it is.
Image numbered_chart(int chart, int width, int height, int channels) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * channels; ++i)
      image.view().row(y)[i] = static_cast<float>(1 + (chart * height + y) * width * channels + i);
  }
  return image;
}

/// In bands of any height, the picture is the one whose cells are drawn each as a whole, and black elsewhere.
TEST(Layout, IsDrawnAlikeInBands) {
  for (const std::string& name : sphere::parameterization_names()) {
    const auto p = AnyParameterization::make(name);
    for (const Layout& original : layouts_of(p)) {
      if (original.kind != LayoutKind::picture) continue;
      for (const Layout& layout : {original, for_reflected_world(original, p)}) {
        const bool turned = std::any_of(layout.cells.begin(), layout.cells.end(),
                                        [](const LayoutCell& cell) { return cell.quarter_turns % 2 != 0; });
        for (const int channels : {1, 2, 3, 4}) {
          const int height = 10, width = turned ? 10 : 14;
          std::vector<Image> images;
          std::vector<ImageView<const float>> charts;
          for (int chart = 0; chart < p.charts(); ++chart)
            images.push_back(numbered_chart(chart, width, height, channels));
          for (const Image& image : images) charts.push_back(image.view());
          Image whole(layout.columns * width, layout.rows * height, channels);
          for (const LayoutCell& cell : layout.cells) {
            copy_to_cell(cell, charts[static_cast<std::size_t>(cell.chart)],
                         cell_of(layout, cell, whole.view()));
          }
          for (const int band : {1, 3, 7, 10, whole.height()}) {
            // What the memory held before must not show.
            Image drawn = numbered_chart(99, whole.width(), whole.height(), channels);
            for (int y = 0; y < whole.height(); y += band) {
              draw_rows(layout, charts, y,
                        drawn.view().part(0, y, whole.width(), std::min(band, whole.height() - y)));
            }
            for (int y = 0; y < whole.height(); ++y) {
              EXPECT_TRUE(
                  std::equal(whole.at(0, y), whole.at(0, y) + whole.width() * channels, drawn.at(0, y)))
                  << p.name() << ":" << layout.name << " row " << y << " in bands of " << band;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace welkin
