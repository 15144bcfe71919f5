#include "myoid/results/references.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::results {
namespace {

constexpr auto kReferences = std::to_array<Reference>({
    {.key = "besomi2020",
     .cited = "Besomi et al. 2020",
     .kind = "article",
     .authors = "Besomi, M. and Hodges, P. W. and Clancy, E. A. and others",
     .title = "Consensus for experimental design in electromyography (CEDE) project: Amplitude normalization matrix",
     .container = "Journal of Electromyography and Kinesiology",
     .year = "2020",
     .volume = "53",
     .pages = "102438",
     .doi = "10.1016/j.jelekin.2020.102438"},
    {.key = "clancy1994",
     .cited = "Clancy and Hogan 1994",
     .kind = "article",
     .authors = "Clancy, E. A. and Hogan, N.",
     .title = "Single site electromyograph amplitude estimation",
     .container = "IEEE Transactions on Biomedical Engineering",
     .year = "1994",
     .volume = "41",
     .number = "2",
     .pages = "159--167",
     .doi = "10.1109/10.284927"},
    {.key = "crowninshield1981",
     .cited = "Crowninshield and Brand 1981",
     .kind = "article",
     .authors = "Crowninshield, R. D. and Brand, R. A.",
     .title = "A physiologically based criterion of muscle force prediction in locomotion",
     .container = "Journal of Biomechanics",
     .year = "1981",
     .volume = "14",
     .number = "11",
     .pages = "793--801",
     .doi = "10.1016/0021-9290(81)90035-X"},
    {.key = "delp2007",
     .cited = "Delp et al. 2007",
     .kind = "article",
     .authors = "Delp, S. L. and Anderson, F. C. and Arnold, A. S. and Loan, P. and Habib, A. and John, C. T. and "
                "Guendelman, E. and Thelen, D. G.",
     .title = "OpenSim: Open-source software to create and analyze dynamic simulations of movement",
     .container = "IEEE Transactions on Biomedical Engineering",
     .year = "2007",
     .volume = "54",
     .number = "11",
     .pages = "1940--1950",
     .doi = "10.1109/TBME.2007.901024"},
    {.key = "lu1999",
     .cited = "Lu and O'Connor 1999",
     .kind = "article",
     .authors = "Lu, T. W. and O'Connor, J. J.",
     .title = "Bone position estimation from skin marker co-ordinates using global optimisation with joint constraints",
     .container = "Journal of Biomechanics",
     .year = "1999",
     .volume = "32",
     .number = "2",
     .pages = "129--134",
     .doi = "10.1016/S0021-9290(98)00158-4"},
    {.key = "newey1987",
     .cited = "Newey and West 1987",
     .kind = "article",
     .authors = "Newey, W. K. and West, K. D.",
     .title = "A simple, positive semi-definite, heteroskedasticity and autocorrelation consistent covariance matrix",
     .container = "Econometrica",
     .year = "1987",
     .volume = "55",
     .number = "3",
     .pages = "703--708",
     .doi = "10.2307/1913610"},
    {.key = "raue2009",
     .cited = "Raue et al. 2009",
     .kind = "article",
     .authors = "Raue, A. and Kreutz, C. and Maiwald, T. and Bachmann, J. and Schilling, M. and Klingm{\\\"u}ller, U. "
                "and Timmer, J.",
     .title = "Structural and practical identifiability analysis of partially observed dynamical models by exploiting "
              "the profile likelihood",
     .container = "Bioinformatics",
     .year = "2009",
     .volume = "25",
     .number = "15",
     .pages = "1923--1929",
     .doi = "10.1093/bioinformatics/btp358"},
    {.key = "venture2006",
     .cited = "Venture et al. 2006",
     .kind = "inproceedings",
     .authors = "Venture, G. and Yamane, K. and Nakamura, Y.",
     .title = "Identification of human musculo-tendon subject specific dynamics using musculo-skeletal computations "
              "and non linear least square",
     .container = "IEEE/RAS-EMBS International Conference on Biomedical Robotics and Biomechatronics (BioRob)",
     .year = "2006"},
    {.key = "woltring1986",
     .cited = "Woltring 1986",
     .kind = "article",
     .authors = "Woltring, H. J.",
     .title = "A Fortran package for generalized, cross-validatory spline smoothing and differentiation",
     .container = "Advances in Engineering Software",
     .year = "1986",
     .volume = "8",
     .number = "2",
     .pages = "104--113",
     .doi = "10.1016/0141-1195(86)90098-7"},
});

std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result(text);
  for (std::size_t at = result.find(from); at != std::string::npos; at = result.find(from, at + to.size()))
    result.replace(at, from.size(), to);
  return result;
}

}  // namespace

std::span<const Reference> all_references() { return kReferences; }

const Reference& reference(std::string_view key) {
  const auto* const found = std::ranges::find(kReferences, key, &Reference::key);
  if (found == kReferences.end()) throw InvalidInput(fmt::format("no reference has the key '{}'", key));
  return *found;
}

std::string printed(const Reference& r) {
  std::string authors = replaced(replaced(r.authors, " and others", " et al."), " and ", "; ");
  authors = replaced(authors, "{\\\"u}", "ü");
  std::string text = fmt::format("{} ({}) {}. {}", authors, r.year, r.title, r.container);
  if (!r.volume.empty()) text += fmt::format(" {}", r.volume);
  if (!r.number.empty()) text += fmt::format("({})", r.number);
  if (!r.pages.empty()) text += fmt::format(": {}", replaced(r.pages, "--", "-"));
  text += '.';
  if (!r.doi.empty()) text += fmt::format(" doi:{}", r.doi);
  return text;
}

std::string bibtex(const Reference& r) {
  std::string text = fmt::format("@{}{{{},\n", r.kind, r.key);
  const auto field = [&](std::string_view name, std::string_view value) {
    if (!value.empty()) text += fmt::format("  {} = {{{}}},\n", name, value);
  };
  field("author", r.authors);
  field("title", r.title);
  field(r.kind == "article" ? "journal" : "booktitle", r.container);
  field("year", r.year);
  field(r.kind == "misc" ? "version" : "volume", r.volume);
  field("number", r.number);
  field("pages", r.pages);
  field("doi", r.doi);
  return text + "}\n";
}

}  // namespace myoid::results
