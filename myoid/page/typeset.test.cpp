#include "myoid/page/typeset.h"

#include <gtest/gtest.h>

namespace myoid::page {
namespace {

TEST(Typographic, SetsWordsAndSignsButNoPartsOfNames) {
  EXPECT_EQ(typographic("R2 0.93, +-15 %"), "R² 0.93, ±15 %");
  EXPECT_EQ(typographic("(mean R2)"), "(mean R²)");
  EXPECT_EQ(typographic("trial R2D, MR2, walk_R2, R20"), "trial R2D, MR2, walk_R2, R20");
  EXPECT_EQ(typographic("swing, 70-134 deg, 4 kg; 176 deg/s"), "swing, 70-134°, 4 kg; 176°/s");
  EXPECT_EQ(typographic("q_1 deg, 5 degrees, angle_2 deg_per_s, in deg"), "q_1°, 5 degrees, angle_2 deg_per_s, in deg");
  EXPECT_EQ(typographic(""), "");
}

TEST(Typeset, EscapesAndShowsCode) {
  EXPECT_EQ(typeset("guide to `myoid check`."), "guide to <code>myoid check</code>.");
  EXPECT_EQ(typeset("`a < b` & R2"), "<code>a &lt; b</code> &amp; R²");
  EXPECT_EQ(typeset("a ` alone"), "a ` alone");
  EXPECT_EQ(typeset("<script>"), "&lt;script&gt;");
}

TEST(Spelled, MakesWordsOfAName) {
  EXPECT_EQ(spelled("max_isometric_force"), "max isometric force");
  EXPECT_EQ(spelled("elbow"), "elbow");
  EXPECT_EQ(spelled("emg_delay"), "EMG delay");
  EXPECT_EQ(spelled("emgs"), "emgs");
}

}  // namespace
}  // namespace myoid::page
