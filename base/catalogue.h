#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace orb {

/// How texts are said to people in one of their languages.
///
/// The program makes English texts; each is translated where it is shown. A key is such a text with
/// a named hole for each part that differs: "`{word}` is not a statement". A hole in backticks
/// holds code, which stays, as does what a robot printed in ""; one in “” what the catalogue knows,
/// or whatever somebody wrote. Any other holds what the catalogue knows, as the reason in "write
/// `{line}`; {why}", or names and figures, which stay. playground/page/catalogue.js reads the same
/// files by the same rules.
class Catalogue {
public:
  /// From JSON: objects with English keys and their translations. Nothing where it is not such.
  static std::optional<Catalogue> read(std::string_view json);
  /// The pseudo-locale of such a file: each text in English, between `⟦` and `⟧`.
  static std::optional<Catalogue> marked(std::string_view json);

  /// The text in that language; where the catalogue does not have it, in English.
  std::string say(std::string_view english) const;
  /// The same, or nothing.
  std::optional<std::string> find(std::string_view english) const;

private:
  struct Hole {
    std::string name;
    std::string_view end; ///< of the quotes around it; empty where there are none
    std::string after;    ///< what follows it
  };
  struct Template {
    std::string before; ///< the first hole
    std::vector<Hole> holes;
    std::string translation;
    std::size_t fixed = 0; ///< bytes that are not in holes
  };
  using Fillers = std::unordered_map<std::string, std::string>;

  static std::optional<Catalogue> of(const nlohmann::json& texts);
  void add(const std::string& english, std::string translation);
  bool fill(const Template& row, std::size_t hole, std::string_view rest, Fillers& fillers) const;
  std::optional<std::string> filler(const Hole& hole, std::string_view text) const;

  std::unordered_map<std::string, std::string> whole_; ///< texts without holes
  std::vector<Template> templates_;                    ///< with the most that is fixed first
};

/// A text with `{name}` holes, filled.
std::string with_holes_filled(std::string_view text,
                              const std::unordered_map<std::string, std::string>& fillers);

} // namespace orb
