#include "myoid/study/draft/channel_muscles.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string_view>

namespace myoid::study {
namespace {

/// The names of a muscle: words that begin a channel's name, and beginnings of a model's.
struct Family {
  const char* name;
  std::vector<std::string_view> in_channels, in_models;
  bool several = false;  ///< Several muscles that have families of their own.
};

// Longer and more specific names come before names that they contain.
const std::vector<Family>& families() {
  static const std::vector<Family> list{
      {"biceps femoris",
       {"bicepsfem", "bifem", "bicfem", "bflh", "bfsh", "bf", "lh", "lathams", "lateralham", "hamlat"},
       {"bifem", "bflh", "bfsh"}},
      {"medial hamstrings", {"mh", "medham", "medialham", "hammed"}, {"semimem", "semiten"}, true},
      {"hamstrings", {"ham"}, {"ham", "semimem", "semiten", "bifem", "bflh", "bfsh"}, true},
      {"brachioradialis", {"brachiorad", "brachrad", "brd", "brachior"}, {"brd", "brachiorad", "brachior"}},
      {"brachialis", {"brachialis", "bra"}, {"bra"}},
      {"biceps brachii", {"biceps", "bicep", "bic", "bb"}, {"bic"}},
      {"triceps brachii", {"triceps", "tricep", "tric", "tri"}, {"tri"}},
      {"anconeus", {"anconeus", "anc"}, {"anc"}},
      {"pronator teres", {"pronator", "pt"}, {"pt", "pronter"}},
      {"extensor carpi radialis", {"extensorcarpiradialis", "ecr"}, {"ecr"}},
      {"flexor carpi radialis", {"flexorcarpiradialis", "fcr"}, {"fcr"}},
      {"anterior deltoid",
       {"deltoidanterior", "anteriordeltoid", "deltant", "deltoida", "delta", "antdelt"},
       {"deltant", "delt1", "deltclav", "delt_ant", "delta"}},
      {"middle deltoid",
       {"deltoidmiddle", "middledeltoid", "deltmed", "deltoidmed", "deltm", "deltoidlat", "deltlat", "middelt"},
       {"deltmid", "delt2", "deltmed", "deltm"}},
      {"posterior deltoid",
       {"deltoidposterior", "posteriordeltoid", "deltpost", "deltoidp", "deltp", "postdelt"},
       {"deltpost", "delt3", "deltscap", "deltp"}},
      {"deltoid", {"deltoid", "delt"}, {"delt"}, true},
      {"pectoralis major", {"pectoralis", "pec", "pecm"}, {"pec"}},
      {"infraspinatus", {"infraspinatus", "infra", "infsp"}, {"infsp", "infra"}},
      {"supraspinatus", {"supraspinatus", "supra", "supsp"}, {"supsp", "supra"}},
      {"soleus", {"soleus", "sol"}, {"soleus", "sol"}},
      {"gastrocnemius lateralis", {"gastrocnemiuslat", "gaslat", "gl", "latgas", "lg"}, {"gaslat", "latgas"}},
      {"gastrocnemius medialis", {"gastrocnemiusmed", "gasmed", "gm", "medgas", "mg"}, {"gasmed", "medgas"}},
      {"gastrocnemius", {"gastrocnemius", "gastroc", "gas"}, {"gas", "medgas", "latgas"}, true},
      {"latissimus dorsi", {"latissimus", "latdor", "lat", "ld"}, {"latdor", "lat"}},
      {"tibialis anterior", {"tibialisanterior", "tibant", "ta", "tibialis"}, {"tibant"}},
      {"rectus femoris", {"rectusfemoris", "rectfem", "recfem", "rf"}, {"rectfem", "recfem"}},
      {"vastus lateralis", {"vastuslat", "vaslat", "vl", "vlo"}, {"vaslat"}},
      {"vastus medialis", {"vastusmed", "vasmed", "vm", "vmo"}, {"vasmed"}},
      {"quadriceps", {"quad"}, {"quad", "rectfem", "recfem", "vas"}, true},
      {"semitendinosus", {"semiten", "semit", "st"}, {"semiten"}},
      {"semimembranosus", {"semimem", "sm"}, {"semimem"}},
      {"peroneus longus", {"peroneuslong", "perlong", "pl"}, {"perlong"}},
      {"gluteus maximus", {"gluteusmax", "glutmax", "gmax"}, {"glutmax", "glmax"}},
      {"gluteus medius", {"gluteusmed", "glutmed", "gmed"}, {"glutmed", "glmed"}},
      {"tensor fasciae latae", {"tensorfasc", "tfl"}, {"tfl"}},
      {"sartorius", {"sartorius", "sar"}, {"sar"}},
      {"gracilis", {"gracilis", "grac"}, {"grac"}},
      {"peroneus brevis", {"peroneusbrev", "perbrev", "pb"}, {"perbrev"}},
      {"erector spinae", {"erectorspin", "erec", "es"}, {"ercspn", "erec"}},
      {"rectus abdominis", {"rectusabd", "rectabd", "ra"}, {"rectabd", "rectusabd"}},
      {"external oblique", {"externalobl", "extobl", "eo"}, {"extobl"}},
      {"internal oblique", {"internalobl", "intobl", "io"}, {"intobl"}},
      {"trapezius", {"trapezius", "trap"}, {"trap"}},
  };
  return list;
}

struct Name {
  std::string letters;  ///< Small letters and digits, without the side and meaningless words.
  char side = ' ';      ///< 'l', 'r', or ' ' where it is not stated.
};

Name name_of(std::string_view text) {
  if (const auto colon = text.rfind(':'); colon != std::string_view::npos && colon + 1 < text.size())
    text.remove_prefix(colon + 1);
  std::vector<std::string> words(1);
  char before = ' ';
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) == 0) {
      words.emplace_back();
    } else {
      // "BicepsRight": a capital after a small letter begins a word.
      if (std::isupper(u) != 0 && std::islower(static_cast<unsigned char>(before)) != 0) words.emplace_back();
      words.back() += static_cast<char>(std::tolower(u));
    }
    before = c;
  }
  static const std::set<std::string, std::less<>> kNoMeaning{
      "emg", "raw",    "env", "envelope", "ch",      "channel", "sensor", "im",     "v",      "mv",     "uv",
      "m",   "muscle", "of",  "the",      "voltage", "imemg",   "rms",    "avanti", "trigno", "brachii"};
  Name name;
  for (const std::string& word : words) {
    if (word.empty() || kNoMeaning.contains(word)) continue;
    if (word == "r" || word == "rt" || word == "right") {
      name.side = 'r';
    } else if (word == "l" || word == "lt" || word == "left") {
      name.side = 'l';
    } else if (!std::ranges::all_of(word, [](char c) { return c >= '0' && c <= '9'; }) || !name.letters.empty()) {
      name.letters += word;
    }
  }
  return name;
}

bool begins_with_any(const std::string& text, const std::vector<std::string_view>& words, bool whole_if_short) {
  return std::ranges::any_of(words, [&](std::string_view w) {
    if (whole_if_short && w.size() <= 2) return text == w;
    return text.starts_with(w);
  });
}

const Family* family_of(const std::string& letters, bool channel) {
  for (const Family& f : families()) {
    if (f.several && !channel) continue;
    if (begins_with_any(letters, channel ? f.in_channels : f.in_models, channel)) return &f;
  }
  return nullptr;
}

/// Returns a channel's name with its side where a side's letter stands at an end of it without a blank: "RRF" is a
/// rectus femoris on the right, "TAL" a left tibialis anterior if a channel "TAR" is there, too. A name that is a
/// muscle's as a whole ("LG", "RECFEM") stays.
Name with_side(Name name, const std::set<std::string>& all) {
  if (name.side != ' ' || name.letters.size() < 3 || family_of(name.letters, true) != nullptr) return name;
  const auto is_side = [](char c) { return c == 'r' || c == 'l'; };
  const std::string behind = name.letters.substr(1), before = name.letters.substr(0, name.letters.size() - 1);
  if (is_side(name.letters.front()) && family_of(behind, true) != nullptr) return {behind, name.letters.front()};
  const char last = name.letters.back();
  if (is_side(last) && family_of(before, true) != nullptr && all.contains(before + (last == 'r' ? 'l' : 'r')))
    return {before, last};
  return name;
}

/// Returns the head or part of a muscle that a name states: 'l'ateral, l'o'ng, 'm'edial, 's'hort; ' ' if none.
char head_of(const std::string& letters, const std::string& family) {
  const auto has = [&](const char* word) { return letters.find(word) != std::string::npos; };
  const bool biceps = family == "biceps brachii";
  if (has("long") || has("caplong") || (biceps && letters == "bicl")) return 'o';
  if (has("short") || has("brev") || (biceps && letters == "bics")) return 's';
  if (has("lat")) return 'l';
  if (has("med")) return 'm';
  return ' ';
}

}  // namespace

std::vector<ChannelMuscles> match_channels(const std::vector<std::string>& channels,
                                           const std::vector<std::string>& muscles) {
  std::vector<ChannelMuscles> result;
  std::map<std::string, int> of_family;
  std::vector<const Family*> family_of_channel;
  std::vector<Name> names;
  std::set<std::string> all;
  for (const std::string& channel : channels) all.insert(name_of(channel).letters);
  for (const std::string& channel : channels) {
    const Name& name = names.emplace_back(with_side(name_of(channel), all));
    const Family* family = family_of(name.letters, true);
    family_of_channel.push_back(family);
    result.push_back({channel, {}, family != nullptr ? family->name : ""});
    if (family != nullptr) ++of_family[std::string(family->name) + name.side];
  }
  for (std::size_t c = 0; c < result.size(); ++c) {
    ChannelMuscles& pair = result[c];
    const Family* const wanted = family_of_channel[c];
    const Name& name = names[c];
    std::vector<std::string> of_head;
    for (const std::string& muscle : muscles) {
      const Name other = name_of(muscle);
      // Models of both sides mark them by a last letter: "soleus_r".
      if (name.side != ' ' && other.side != ' ' && name.side != other.side) continue;
      const bool same = wanted != nullptr && wanted->several ? begins_with_any(other.letters, wanted->in_models, false)
                        : wanted != nullptr                  ? family_of(other.letters, false) == wanted
                                            : name.letters.size() > 2 && (other.letters.starts_with(name.letters) ||
                                                                          name.letters.starts_with(other.letters));
      if (!same) continue;
      pair.muscles.push_back(muscle);
      const char head = head_of(name.letters, pair.family);
      if (head != ' ' && head == head_of(other.letters, pair.family)) of_head.push_back(muscle);
    }
    // A single electrode stands for all heads, several each for their own.
    if (of_family[pair.family + name.side] > 1 && !of_head.empty()) pair.muscles = of_head;
  }
  return result;
}

Limbs limbs_of(const std::vector<std::string>& channels) {
  constexpr std::array<std::string_view, 6> kArm{"brachi", "anconeus", "pronator", "carpi", "deltoid", "pectoralis"};
  constexpr std::array<std::string_view, 12> kLeg{"femoris",  "hamstrings", "soleus",     "gastrocnemius",
                                                  "tibialis", "vastus",     "quadriceps", "semi",
                                                  "peroneus", "gluteus",    "sartorius",  "gracilis"};
  Limbs limbs;
  for (const ChannelMuscles& pair : match_channels(channels, {})) {
    const auto has = [&](std::string_view word) { return pair.family.find(word) != std::string::npos; };
    limbs.arm = limbs.arm || std::ranges::any_of(kArm, has);
    limbs.leg = limbs.leg || std::ranges::any_of(kLeg, has);
  }
  return limbs;
}

}  // namespace myoid::study
