#include "myoid/page/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/numbers.h"
#include "myoid/page/svg_path.h"
#include "myoid/page/typeset.h"

namespace myoid::page {
namespace {

constexpr double kWidth = 760.0;
constexpr double kLeft = 58.0;
constexpr double kRight = 12.0;
constexpr double kTop = 24.0;
constexpr double kBottom = 42.0;
constexpr double kLegendRow = 18.0;
constexpr double kBinWidth = 3.0;

struct Style {
  const char* color;
  const char* dash;  ///< Empty: solid.
  double width;
};

/// Returns the style of a role; the table is in the order of the enumerators.
const Style& style_of(Role role) {
  static constexpr std::array<Style, 10> kStyles{{{"#1f5fa8", "", 1.6},
                                                  {"#6b6b6b", "2 3", 1.5},
                                                  {"#d1491b", "6 3", 1.7},
                                                  {"#111", "", 1.1},
                                                  {"#b9bec4", "", 0.7},
                                                  {"#d1491b", "", 0.0},
                                                  {"#00694b", "7 2 1.5 2", 1.5},
                                                  {"#5a626b", "", 0.0},
                                                  {"#3d8fc4", "", 0.0},
                                                  {"#1f5fa8", "", 1.3}}};
  return kStyles[static_cast<std::size_t>(role)];
}

/// Returns the attribute of a dashed line; empty for a solid one.
std::string dash_of(const Style& style) {
  return *style.dash == '\0' ? "" : fmt::format(" stroke-dasharray=\"{}\"", style.dash);
}

bool is_area(Role role) { return role == Role::band || role == Role::range || role == Role::norm; }

std::string disc(double x, double y, double radius, const char* color) {
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", x, y, radius, color);
}

struct Range {
  double lower = kInfinity;
  double upper = -kInfinity;

  void take(double value) {
    if (!std::isfinite(value)) return;
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
  void take(const std::vector<double>& values) {
    for (const double value : values) take(value);
  }
  /// Makes the range not empty and adds a margin of this share.
  void open(double margin) {
    if (!(lower <= upper)) {
      lower = 0.0;
      upper = 1.0;
    }
    if (lower == upper) {
      const double half = lower == 0.0 ? 1.0 : 0.1 * std::abs(lower);
      lower -= half;
      upper += half;
      return;
    }
    const double width = upper - lower;
    lower -= margin * width;
    upper += margin * width;
  }
};

Range range_of(const Panel& panel, bool horizontal) {
  const Axis& axis = horizontal ? panel.x : panel.y;
  Range range;
  if (!axis.categories.empty()) {
    range.lower = -0.6;
    range.upper = static_cast<double>(axis.categories.size()) - 0.4;
    return range;
  }
  for (const Series& series : panel.series) {
    if (horizontal) range.take(series.x);
    if (!horizontal)
      for (const auto* values : {&series.y, &series.y_lower, &series.y_upper}) range.take(*values);
  }
  range.open(horizontal ? 0.0 : 0.05);
  if (axis.lower) range.lower = *axis.lower;
  if (axis.upper) range.upper = *axis.upper;
  if (!(range.lower < range.upper)) range.upper = range.lower + 1.0;
  return range;
}

std::string axis_title(const Axis& axis) {
  if (axis.unit.empty()) return axis.label;
  return axis.label.empty() ? fmt::format("[{}]", axis.unit) : fmt::format("{} [{}]", axis.label, axis.unit);
}

/// Returns a title or name as short as a drawing has room for.
std::string shown_in_drawing(std::string_view text) {
  constexpr std::size_t kMostInWord = 60, kMostInText = 160;
  return elided(with_short_words(text, kMostInWord), kMostInText);
}

std::string text(double x,
                 double y,
                 std::string_view content,
                 std::string_view anchor = "middle",
                 double size = 11.0,
                 std::string_view more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:g}\" text-anchor=\"{}\" {}>{}</text>\n", x, y, size,
                     anchor, more, escape_xml(typographic(shown_in_drawing(content))));
}

/// One panel, in a frame at (left, top) of the given size.
class PanelDrawing {
 public:
  PanelDrawing(const Panel& panel, double left, double top, double width, double height)
      : panel_(panel),
        left_(left),
        top_(top),
        width_(width),
        height_(height),
        x_(range_of(panel, true)),
        y_(range_of(panel, false)) {}

  [[nodiscard]] std::string draw(const std::string& clip) const {
    std::string svg = axes();
    svg += fmt::format(
        "<clipPath id=\"{}\"><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>"
        "</clipPath>\n<g clip-path=\"url(#{})\">\n",
        clip, left_, top_, width_, height_, clip);
    for (const bool behind : {true, false}) {
      for (const Series& series : panel_.series) {
        const bool back = series.role == Role::band || series.role == Role::raw;
        if (back == behind) svg += curve(series);
      }
    }
    svg += "</g>\n";
    svg += text(left_ + 0.5 * width_, top_ - 7.0, panel_.title, "middle", 12.0, "font-weight=\"600\"");
    return svg;
  }

 private:
  /// Returns the number of stretches of which a curve shows begin, end, least and greatest value.
  [[nodiscard]] std::size_t bins() const { return static_cast<std::size_t>(width_ / kBinWidth); }
  [[nodiscard]] double px(double x) const { return left_ + width_ * (x - x_.lower) / (x_.upper - x_.lower); }
  [[nodiscard]] double py(double y) const { return top_ + height_ * (1.0 - (y - y_.lower) / (y_.upper - y_.lower)); }

  [[nodiscard]] std::string axes() const {
    std::string svg;
    const auto grid = [&](double x1, double y1, double x2, double y2, const char* color) {
      svg += fmt::format(
          "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
          "stroke-width=\"0.8\"/>\n",
          x1, y1, x2, y2, color);
    };
    const double bottom = top_ + height_;
    const auto mark_x = [&](double at, const std::string& label) {
      grid(px(at), top_, px(at), bottom, "#e6e8eb");
      svg += text(px(at), bottom + 14.0, label, "middle", 10.0);
    };
    const std::vector<std::string>& categories = panel_.x.categories;
    for (std::size_t k = 0; k < categories.size(); ++k) mark_x(static_cast<double>(k), categories[k]);
    if (categories.empty())
      for (const double at : ticks(x_.lower, x_.upper, width_ > 300.0 ? 8 : 4)) mark_x(at, format_value(at, 6));
    for (const double at : ticks(y_.lower, y_.upper, 5)) {
      grid(left_, py(at), left_ + width_, py(at), at == 0.0 ? "#b5bac0" : "#e6e8eb");
      svg += text(left_ - 5.0, py(at) + 3.5, format_value(at, 6), "end", 10.0);
    }
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
        "stroke=\"#8a9097\" stroke-width=\"0.8\"/>\n",
        left_, top_, width_, height_);
    svg += text(left_ + 0.5 * width_, bottom + 30.0, axis_title(panel_.x));
    const double y_x = left_ - 44.0;
    const double y_y = top_ + 0.5 * height_;
    svg += text(y_x, y_y, axis_title(panel_.y), "middle", 11.0,
                fmt::format("transform=\"rotate(-90 {:.1f} {:.1f})\"", y_x, y_y));
    return svg;
  }

  [[nodiscard]] std::string curve(const Series& series) const {
    if (is_area(series.role)) return band(series);
    if (series.role == Role::points) return points(series);
    SvgPath path;
    for (const std::size_t k : decimate(series.y, bins())) {
      if (std::isfinite(series.x[k]) && std::isfinite(series.y[k])) {
        path.line(px(series.x[k]), py(series.y[k]));
      } else {
        path.lift();
      }
    }
    const Style& style = style_of(series.role);
    return fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
        "stroke-linejoin=\"round\"{}/>\n",
        path.text(), style.color, style.width, dash_of(style));
  }

  /// Returns the stretches without gaps, each as a closed area.
  [[nodiscard]] std::string band(const Series& series) const {
    SvgPath path;
    std::size_t k = 0;
    const auto good = [&](std::size_t i) {
      return std::isfinite(series.x[i]) && std::isfinite(series.y[i]) && std::isfinite(series.y_upper[i]);
    };
    while (k < series.y.size()) {
      if (!good(k)) {
        ++k;
        continue;
      }
      std::size_t end = k;
      while (end < series.y.size() && good(end)) ++end;
      const std::size_t step = std::max<std::size_t>(1, (end - k) / (2 * bins()));
      std::vector<std::pair<double, double>> upper_edge;
      for (std::size_t i = k; i < end; i += step) {
        // A coarser band must still enclose the whole range.
        const std::size_t next = std::min(i + step, end);
        double low = series.y[i];
        double high = series.y_upper[i];
        for (std::size_t j = i; j < next; ++j) {
          low = std::min(low, series.y[j]);
          high = std::max(high, series.y_upper[j]);
        }
        path.line(px(series.x[i]), py(low));
        upper_edge.emplace_back(px(series.x[i]), py(high));
      }
      for (auto at = upper_edge.rbegin(); at != upper_edge.rend(); ++at) path.line(at->first, at->second);
      path.close();
      k = end;
    }
    return fmt::format("<path d=\"{}\" fill=\"{}\" fill-opacity=\"0.16\" stroke=\"none\"/>\n", path.text(),
                       style_of(series.role).color);
  }

  [[nodiscard]] std::string points(const Series& series) const {
    const Style& style = style_of(series.role);
    std::string svg;
    const bool bars = !series.y_lower.empty() && !series.y_upper.empty();
    for (std::size_t k = 0; k < series.y.size(); ++k) {
      if (!std::isfinite(series.x[k]) || !std::isfinite(series.y[k])) continue;
      if (bars && std::isfinite(series.y_lower[k]) && std::isfinite(series.y_upper[k])) {
        svg += fmt::format(
            "<path d=\"M{0:.1f} {1:.1f}L{0:.1f} {2:.1f}M{3:.1f} {1:.1f}H{4:.1f}M{3:.1f} {2:.1f}"
            "H{4:.1f}\" stroke=\"{5}\" stroke-width=\"{6}\" fill=\"none\"/>\n",
            px(series.x[k]), py(series.y_lower[k]), py(series.y_upper[k]), px(series.x[k]) - 3.0, px(series.x[k]) + 3.0,
            style.color, style.width);
      }
      svg += disc(px(series.x[k]), py(series.y[k]), bars ? 3.0 : 2.0, style.color);
    }
    return svg;
  }

  const Panel& panel_;
  double left_, top_, width_, height_;
  Range x_, y_;
};

struct LegendEntry {
  std::string name;
  Role role;
  bool operator==(const LegendEntry&) const = default;
};

/// Returns every name once, in order of appearance.
std::vector<LegendEntry> legend_of(const Figure& figure) {
  std::vector<LegendEntry> entries;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      const LegendEntry entry{series.name, series.role};
      if (!series.name.empty() && std::ranges::find(entries, entry) == entries.end()) entries.push_back(entry);
    }
  }
  return entries;
}

double entry_width(const LegendEntry& entry) { return 44.0 + 6.2 * static_cast<double>(entry.name.size()); }

std::string legend_mark(Role role, double x, double y) {
  const Style& style = style_of(role);
  if (is_area(role)) {
    return fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"24\" height=\"9\" fill=\"{}\" "
        "fill-opacity=\"0.16\"/>\n",
        x, y - 8.0, style.color);
  }
  if (role == Role::points) return disc(x + 12.0, y - 4.0, 3.0, style.color);
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
      "stroke-width=\"{}\"{}/>\n",
      x, y - 4.0, x + 24.0, y - 4.0, style.color, std::max(style.width, 1.0), dash_of(style));
}

}  // namespace

std::vector<double> ticks(double lower, double upper, int count) {
  const double rough = (upper - lower) / std::max(count, 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * (1.0 - 1e-9)) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> result;
  const double tolerance = 1e-9 * step;
  for (double k = std::ceil((lower - tolerance) / step); k * step <= upper + tolerance; k += 1.0) {
    result.push_back(k == 0.0 ? 0.0 : k * step);
  }
  return result;
}

std::vector<std::size_t> decimate(const std::vector<double>& y, std::size_t bins) {
  std::vector<std::size_t> keep;
  const std::size_t n = y.size();
  if (n <= 4 * bins || bins == 0) {
    keep.resize(n);
    std::iota(keep.begin(), keep.end(), std::size_t{0});
    return keep;
  }
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const std::size_t begin = bin * n / bins;
    const std::size_t end = (bin + 1) * n / bins;
    std::vector<std::size_t> chosen = {begin, end - 1};
    std::size_t lowest = begin;
    std::size_t highest = begin;
    for (std::size_t k = begin; k < end; ++k) {
      if (!std::isfinite(y[k])) {
        // A single gap is enough to split the curve.
        if (k == begin || std::isfinite(y[k - 1])) chosen.push_back(k);
        continue;
      }
      if (!(y[k] >= y[lowest])) lowest = k;  // true also if y[lowest] is not finite
      if (!(y[k] <= y[highest])) highest = k;
    }
    chosen.push_back(lowest);
    chosen.push_back(highest);
    std::ranges::sort(chosen);
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    keep.insert(keep.end(), chosen.begin(), chosen.end());
  }
  return keep;
}

std::string svg_plot(const Figure& figure) {
  const auto columns = static_cast<std::size_t>(std::max(1, figure.columns));
  const double cell_width = kWidth / static_cast<double>(columns);
  const double plot_width = cell_width - kLeft - kRight;
  const double plot_height = columns == 1 ? 220.0 : columns == 2 ? 180.0 : 150.0;
  const double cell_height = kTop + plot_height + kBottom;

  // The legend stands above all panels, in as many rows as necessary.
  std::string legend;
  double x = kLeft;
  double y = 14.0;
  const std::vector<LegendEntry> entries = legend_of(figure);
  for (const LegendEntry& entry : entries) {
    if (x > kLeft && x + entry_width(entry) > kWidth) {
      x = kLeft;
      y += kLegendRow;
    }
    legend += legend_mark(entry.role, x, y) + text(x + 30.0, y, entry.name, "start");
    x += entry_width(entry);
  }
  const double head = entries.empty() ? 4.0 : y + 10.0;

  const std::size_t rows = (figure.panels.size() + columns - 1) / columns;
  const double height = head + static_cast<double>(rows) * cell_height;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:.0f}\" width=\"{0:g}\" "
      "height=\"{1:.0f}\" role=\"img\" font-family=\"Helvetica, Arial, sans-serif\" "
      "fill=\"#22262b\">\n<title>{2}</title>\n<desc>{3}</desc>\n",
      kWidth, height, escape_xml(shown_in_drawing(figure.title)), escape_xml(typographic(figure.caption)));
  svg += legend;
  for (std::size_t k = 0; k < figure.panels.size(); ++k) {
    const double left = static_cast<double>(k % columns) * cell_width + kLeft;
    const double top = head + static_cast<double>(k / columns) * cell_height + kTop;
    // Clip names are unique in a page of several figures.
    svg +=
        PanelDrawing(figure.panels[k], left, top, plot_width, plot_height).draw(fmt::format("{}-clip{}", figure.id, k));
  }
  return svg + "</svg>\n";
}

}  // namespace myoid::page
