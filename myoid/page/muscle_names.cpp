#include "myoid/page/muscle_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "myoid/ground/files/text_file.h"

namespace myoid::page {
namespace {

using Entry = std::pair<std::string_view, std::string_view>;

/// Abbreviations in small letters without underscores: of studies, and of OpenSim's models of leg, arm and trunk. An
/// abbreviation of two muscles (GM) has no entry.
constexpr std::array kNames{
    Entry{"bic", "biceps"},
    Entry{"biclong", "biceps long head"},
    Entry{"bicshort", "biceps short head"},
    Entry{"bra", "brachialis"},
    Entry{"brd", "brachioradialis"},
    Entry{"tri", "triceps"},
    Entry{"trilong", "triceps long head"},
    Entry{"trilat", "triceps lateral head"},
    Entry{"trimed", "triceps medial head"},
    Entry{"anc", "anconeus"},
    Entry{"ecrl", "extensor carpi radialis longus"},
    Entry{"ecrb", "extensor carpi radialis brevis"},
    Entry{"ecu", "extensor carpi ulnaris"},
    Entry{"fcr", "flexor carpi radialis"},
    Entry{"fcu", "flexor carpi ulnaris"},
    Entry{"delt1", "deltoid anterior"},
    Entry{"delt2", "deltoid middle"},
    Entry{"delt3", "deltoid posterior"},
    Entry{"infsp", "infraspinatus"},
    Entry{"supsp", "supraspinatus"},
    Entry{"subsc", "subscapularis"},
    Entry{"tmaj", "teres major"},
    Entry{"tmin", "teres minor"},
    Entry{"pecm", "pectoralis major"},
    Entry{"lat", "latissimus dorsi"},
    Entry{"corb", "coracobrachialis"},
    Entry{"sol", "soleus"},
    Entry{"soleus", "soleus"},
    Entry{"gasmed", "gastrocnemius medialis"},
    Entry{"medgas", "gastrocnemius medialis"},
    Entry{"gaslat", "gastrocnemius lateralis"},
    Entry{"latgas", "gastrocnemius lateralis"},
    Entry{"gastroc", "gastrocnemius"},
    Entry{"ta", "tibialis anterior"},
    Entry{"tibant", "tibialis anterior"},
    Entry{"tibpost", "tibialis posterior"},
    Entry{"perbrev", "peroneus brevis"},
    Entry{"perlong", "peroneus longus"},
    Entry{"pertert", "peroneus tertius"},
    Entry{"edl", "extensor digitorum longus"},
    Entry{"extdig", "extensor digitorum longus"},
    Entry{"ehl", "extensor hallucis longus"},
    Entry{"exthal", "extensor hallucis longus"},
    Entry{"fdl", "flexor digitorum longus"},
    Entry{"flexdig", "flexor digitorum longus"},
    Entry{"fhl", "flexor hallucis longus"},
    Entry{"flexhal", "flexor hallucis longus"},
    Entry{"rf", "rectus femoris"},
    Entry{"recfem", "rectus femoris"},
    Entry{"rectfem", "rectus femoris"},
    Entry{"vl", "vastus lateralis"},
    Entry{"vaslat", "vastus lateralis"},
    Entry{"vm", "vastus medialis"},
    Entry{"vasmed", "vastus medialis"},
    Entry{"vi", "vastus intermedius"},
    Entry{"vasint", "vastus intermedius"},
    Entry{"vasti", "vasti"},
    Entry{"bflh", "biceps femoris long head"},
    Entry{"bifemlh", "biceps femoris long head"},
    Entry{"bfsh", "biceps femoris short head"},
    Entry{"bifemsh", "biceps femoris short head"},
    Entry{"semimem", "semimembranosus"},
    Entry{"semiten", "semitendinosus"},
    Entry{"hamstrings", "hamstrings"},
    Entry{"grac", "gracilis"},
    Entry{"sar", "sartorius"},
    Entry{"sart", "sartorius"},
    Entry{"tfl", "tensor fasciae latae"},
    Entry{"iliacus", "iliacus"},
    Entry{"psoas", "psoas"},
    Entry{"iliopsoas", "iliopsoas"},
    Entry{"piri", "piriformis"},
    Entry{"peri", "piriformis"},
    Entry{"glmax", "gluteus maximus"},
    Entry{"glutmax", "gluteus maximus"},
    Entry{"glmed", "gluteus medius"},
    Entry{"glutmed", "gluteus medius"},
    Entry{"glmin", "gluteus minimus"},
    Entry{"glutmin", "gluteus minimus"},
    Entry{"addbrev", "adductor brevis"},
    Entry{"addlong", "adductor longus"},
    Entry{"addmag", "adductor magnus"},
    Entry{"quadfem", "quadratus femoris"},
    Entry{"ercspn", "erector spinae"},
    Entry{"intobl", "internal oblique"},
    Entry{"extobl", "external oblique"},
};

std::string_view known_name(std::string_view letters) {
  const auto entry = std::ranges::find(kNames, letters, &Entry::first);
  return entry == kNames.end() ? std::string_view() : entry->second;
}

}  // namespace

std::string plain_muscle(std::string_view name) {
  std::string letters = small_letters(std::string(name));
  std::string ending;
  for (const auto& [side, word] : {Entry{"_r", " (right)"}, Entry{"_l", " (left)"}}) {
    if (!letters.ends_with(side)) continue;
    letters.resize(letters.size() - side.size());
    ending = word;
    break;
  }
  std::erase(letters, '_');
  std::string_view known = known_name(letters);
  if (known.empty() && !letters.empty() && std::isdigit(static_cast<unsigned char>(letters.back())) != 0) {
    ending = std::string(", part ") + letters.back() + ending;
    letters.pop_back();
    known = known_name(letters);
  }
  if (known.empty()) return std::string(name);
  std::string plain = std::string(known) + ending;
  plain.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(plain.front())));
  return plain;
}

std::string plain_muscle_and_name(std::string_view name) {
  std::string plain = plain_muscle(name);
  if (small_letters(plain) != small_letters(std::string(name))) plain += " (" + std::string(name) + ")";
  return plain;
}

}  // namespace myoid::page
