#pragma once

#include <span>
#include <string>
#include <string_view>

namespace myoid {

/// A publication that a methods section cites. Fields that the kind lacks are empty.
struct Reference {
  std::string_view key;      ///< Of the BibTeX entry: "lu1999".
  std::string_view cited;    ///< In the running text: "Lu and O'Connor 1999".
  std::string_view kind;     ///< "article", "inproceedings", "misc"
  std::string_view authors;  ///< In BibTeX's form, parted by " and ".
  std::string_view title, container, year;
  std::string_view volume;  ///< Of a "misc" entry: the version.
  std::string_view number, pages, doi;
};

/// All publications that the program can cite, in alphabetical order of the keys.
[[nodiscard]] std::span<const Reference> all_references();

/// Throws InvalidInput for a key that no reference has.
[[nodiscard]] const Reference& reference(std::string_view key);

/// "Lu, T. W.; O'Connor, J. J. (1999) Title. Journal 32(2): 129-134. doi:..."
[[nodiscard]] std::string printed(const Reference& reference);

/// The BibTeX entry, in lines.
[[nodiscard]] std::string bibtex(const Reference& reference);

}  // namespace myoid
