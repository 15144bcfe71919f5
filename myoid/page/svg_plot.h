#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/files/quoted_text.h"
#include "myoid/page/report.h"

namespace myoid::page {

using ground::escape_xml;

/// Draws the figure as one SVG document that needs no style sheet, font file or network. The same input gives the same
/// bytes. The color-blind can tell the colors apart; lines differ in their dashes too.
[[nodiscard]] std::string svg_plot(const Figure& figure);

/// Returns round numbers that cover [lower, upper] with about `count` intervals: steps of 1, 2 or 5
/// times a power of ten, none outside. Precondition: lower < upper, both finite.
[[nodiscard]] std::vector<double> ticks(double lower, double upper, int count);

/// Returns the positions of the samples to draw, in order, so that a curve of many samples looks the same: in each of
/// `bins` equal stretches the first, the lowest, the highest and the last. All of them if there are no more than 4
/// `bins`. Samples that are not finite stay where they part the curve.
[[nodiscard]] std::vector<std::size_t> decimate(const std::vector<double>& y, std::size_t bins);

}  // namespace myoid::page
