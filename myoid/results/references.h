#pragma once

#include <span>
#include <string>
#include <string_view>

namespace myoid::results {

/// A publication that a methods section cites. Fields that its kind lacks are empty.
struct Reference {
  std::string_view key;      ///< Key of the BibTeX entry: "lu1999".
  std::string_view cited;    ///< Citation in the running text: "Lu and O'Connor 1999".
  std::string_view kind;     ///< "article", "inproceedings", "misc"
  std::string_view authors;  ///< In BibTeX's form, separated by " and ".
  std::string_view title, container{}, year{};
  std::string_view volume{};  ///< For a "misc" entry: the version.
  std::string_view number{}, pages{}, doi{};
};

/// Returns all publications that the program can cite, in alphabetical order of the keys.
[[nodiscard]] std::span<const Reference> all_references();

/// Returns the reference with this key. Throws InvalidInput if there is none.
[[nodiscard]] const Reference& reference(std::string_view key);

/// Returns "Lu, T. W.; O'Connor, J. J. (1999) Title. Journal 32(2): 129-134. doi:..."
[[nodiscard]] std::string printed(const Reference& reference);

/// Returns the BibTeX entry, in lines.
[[nodiscard]] std::string bibtex(const Reference& reference);

}  // namespace myoid::results
