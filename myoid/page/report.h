#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace myoid::page {

/// The meaning of a curve. It decides how the curve is drawn, alike in every figure.
enum class Role {
  reference,   ///< Measured, or the reference of the others: solid blue.
  literature,  ///< Computed with the literature's parameters: dashed grey.
  identified,  ///< Computed with the identified parameters: dashed orange-red.
  truth,       ///< Known truth of a virtual recording: solid black, thin.
  raw,         ///< As recorded, before processing: thin light grey.
  band,        ///< Area between y and y_upper: light.
  unseen,      ///< Predicted without this recording: dash-dotted green.
  range,       ///< Area between y and y_upper that the recording visited: grey.
  norm,        ///< Area between y and y_upper of a group of people: light blue.
  points,      ///< Markers without a line; with y_lower/y_upper an error bar.
};

/// A curve. x and y have equal lengths; NaN in y is a gap. `y_upper` (and `y_lower` for points)
/// have this length if used.
struct Series {
  std::string name;  ///< In the legend; empty: no entry.
  std::vector<double> x{}, y{};
  Role role = Role::reference;
  std::vector<double> y_lower{};  ///< points: lower end of the error bar. band: empty, y is the lower edge.
  std::vector<double> y_upper{};  ///< band: upper edge. points: upper end of the error bar.
};

struct Axis {
  std::string label;                       ///< "elbow flexion"
  std::string unit{};                      ///< "deg", "N m"; empty: dimensionless
  std::optional<double> lower{}, upper{};  ///< Empty: from the data.
  std::vector<std::string> categories{};   ///< Names at x = 0, 1, 2, ...: instead of numbers.
};

struct Panel {
  std::string title;
  Axis x{}, y{};
  std::vector<Series> series{};
};

struct Figure {
  std::string id;  ///< Any text; `make_ids` makes the name of its files from it, "forces_flex_slow".
  std::string title;
  std::string caption;  ///< Description, one or two sentences.
  std::vector<Panel> panels{};
  int columns = 1;  ///< Panels side by side.
  /// First lines of ID.csv, each behind "# ": the origin of the numbers.
  std::vector<std::string> comments{};
  int most_on_page = 0;  ///< The page draws the first panels only; 0: all. The files have all.
  std::string bad{};     ///< How the figure looks if something is wrong; one or two sentences.
  std::string act{};     ///< Advice to the reader.
  /// True if the workbench shows this figure: the page then shows the drawing in print and without script only.
  bool in_workbench = false;
};

/// The quality of a value, shown as a small colored word.
enum class Badge { none, good, weak, bad, info, repeat };

struct Cell {
  std::string text;
  Badge badge = Badge::none;
  std::string hint{};  ///< A sentence shown when pointing at the cell, and in print after the table.
};

struct Table {
  std::string id{};
  std::string title{};
  std::string caption{};
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows{};  ///< As many cells as columns each.
};

enum class GateStatus { pass, warn, fail, info };

/// One question that the data had to pass, with the answer.
struct Gate {
  std::string name;  ///< "Markers fit the model"
  GateStatus status = GateStatus::info;
  std::string value;      ///< "4.1 mm rms"
  std::string threshold;  ///< "below 10 mm"
  std::string why;        ///< Consequence of the answer, one sentence.
  bool explains = false;  ///< A mistake that explains other answers: it is named first and in full.
  bool asked = true;      ///< False: the question counts neither as answered nor as open.
};

/// One estimated number beside the knowledge before the recording: a row of the forest plot.
struct ForestRow {
  std::string owner;  ///< "BIC"
  std::string name;   ///< "optimal fiber length"
  std::string unit;   ///< Empty: dimensionless.
  double estimate = 0.0;
  std::optional<double> lower, upper;  ///< 95 % interval of the person.
  /// Value and 95 % interval given geometry and sensors; empty: the fit has one reading.
  std::optional<double> given_estimate{}, given_lower{}, given_upper{};
  std::optional<double> prior_mean, prior_sd;  ///< Without both of them the row has no bar.
  std::optional<double> truth;                 ///< In a virtual recording.
  std::string verdict;                         ///< "identified"
  Badge badge = Badge::none;                   ///< Badge of the verdict; determines color and shape.
  std::string why;                             ///< The reason of the verdict, a sentence.
  std::string about{};                         ///< The meaning of the number, a sentence.
  bool beside = false;                         ///< A number of an electrode or a joint, below the muscles' numbers.
};

/// A number of one person in a strip plot. Without a value the cell is empty.
struct StripCell {
  std::optional<double> value{};
  std::optional<double> lower{}, upper{};  ///< 95 % interval of the person.
  /// Value and 95 % interval given geometry and sensors; empty: the number has one reading.
  std::optional<double> given_value{}, given_lower{}, given_upper{};
  std::optional<double> truth{};  ///< In a virtual recording.
  std::string verdict{};          ///< "identified"; empty for numbers without one.
  Badge badge = Badge::none;      ///< Badge of the verdict; determines color and shape.
  bool outlier = false;           ///< Far from the other persons.
};

/// A number that the persons share. Its cells have one scale.
struct StripColumn {
  std::string name;                                   ///< "BIC"
  std::string unit{};                                 ///< Empty: dimensionless.
  std::optional<double> middle{};                     ///< A line behind the persons.
  std::optional<double> spread_low{}, spread_high{};  ///< A field behind the persons.
};

struct StripRow {
  std::string person;
  std::string page{};              ///< The person's own report, relative; empty: none.
  std::vector<StripCell> cells{};  ///< As many as columns.
};

/// Numbers of many persons: a row a person, a column a number.
struct StripGrid {
  std::string id;
  std::string title;
  std::string caption;
  std::vector<StripColumn> columns{};
  std::vector<StripRow> rows{};
};

/// A number of one session.
struct SessionValue {
  double value = 0.0;
  std::optional<double> lower{}, upper{};  ///< 95 % interval.
};

/// A number of two sessions.
struct ChangeRow {
  std::string owner, name, unit;
  SessionValue first, second;
  std::optional<double> detectable;  ///< The smallest change that the recordings detect; empty: not compared.
  std::string verdict;
  Badge badge = Badge::none;
};

/// Numbers of two sessions: a row a number.
struct ChangeForest {
  std::string first, second;  ///< Names of the sessions.
  std::vector<ChangeRow> rows{};
};

/// Another file of the run, by its name relative to the report.
struct Link {
  std::string text;
  std::string file;
};

struct Section {
  std::string id;
  std::string heading;
  bool before_numbers = false;            ///< The section stands before the table of all numbers.
  bool folded = false;                    ///< Only the heading shows until a reader opens the section.
  std::vector<std::string> paragraphs{};  ///< Plain text.
  std::vector<Gate> gates{};
  std::vector<Table> tables{};
  std::vector<Figure> figures{};
  std::vector<StripGrid> grids{};  ///< Before the tables on the page.
  ChangeForest changes{};          ///< Before the tables; may be empty.
};

struct ProvenanceRow {
  std::string what;
  std::string value;
};

/// The answer to a question that a reader has at first sight.
struct Answer {
  std::string question;
  std::string text;
  std::string section{};  ///< Id of the section that tells more; empty: none.
};

/// All results of a run for a reader, as a value without any formatting.
struct Report {
  std::string title;
  std::string subtitle{};           ///< Who, when, which data.
  std::string headline{};           ///< The result in two or three sentences.
  std::vector<Answer> answers{};    ///< Further results, below the headline.
  std::vector<Link> links{};        ///< Beside the report, to look at.
  std::vector<Gate> gates{};        ///< First of all: may the numbers below be believed?
  std::vector<ForestRow> forest{};  ///< All numbers in one picture; may be empty.
  std::vector<Section> sections{};
  std::vector<std::string> assumptions{};
  std::vector<ProvenanceRow> provenance{};  ///< Version, inputs with hashes, options.
};

/// Throws InvalidInput, naming the figure or table, if series have unequal lengths or rows unequal numbers of cells.
void validate(const Report& report);

/// Makes the ids of sections, of tables and grids, and of figures unique names of files (`ids_of`).
void make_ids(Report& report);

/// Returns the samples as a curve's values.
[[nodiscard]] std::vector<double> to_vector(const Eigen::Ref<const Eigen::VectorXd>& samples);

/// Returns an empty panel over the time in seconds.
[[nodiscard]] Panel time_panel(std::string title, std::string label, std::string unit);

/// Formats a number for people: `digits` significant ones, no exponent between 1e-4 and 1e6.
[[nodiscard]] std::string format_value(double value, int digits = 3);

/// Formats a number with the decimals that show two digits of `width`, for example of its interval:
/// "0.140" beside a width of 0.017. Zeros at the end are kept, so that a column can be compared.
[[nodiscard]] std::string format_rounded(double value, double width);

/// Formats a number with the decimals of its interval, or as format_value if there is none.
[[nodiscard]] std::string format_beside(double value,
                                        const std::optional<double>& lower,
                                        const std::optional<double>& upper);

/// Formats an interval, "0.1363 to 0.1371": both ends with the decimals that show two digits of the width.
[[nodiscard]] std::string format_interval(double lower, double upper, std::string_view between = " to ");

}  // namespace myoid::page
