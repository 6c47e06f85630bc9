#pragma once

// Private to repair/.

#include "repair/repair.h"
#include "repair/scenery.h"
#include "repair/search.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace orb::repair {

/// Whether a word is one of them, in capitals or not.
bool has_word(const std::vector<std::string_view>& words, std::string_view word);

/// Whether a finding is about a word that means nothing.
inline bool is_unknown(const Diagnostic& finding) {
  return finding.rule->trouble == Trouble::UnknownName ||
         finding.rule->trouble == Trouble::ForeignWord;
}
inline bool is_unclosed(const Diagnostic& finding) {
  return finding.rule->trouble == Trouble::UnclosedBlock;
}
inline bool is_block_end(const Diagnostic& finding) {
  return finding.rule->trouble == Trouble::BlockEnd;
}

std::size_t errors_in(const std::vector<Diagnostic>& findings);

/// Lines that were tried in the place of one.
struct Accepted {
  std::string text;                ///< the whole line; several, each with its end but the last
  const orb::Text* note = nullptr; ///< why it is so; null where nothing is said
  bool fewer = false;              ///< the text has fewer errors with it
  bool quiet = false;              ///< nothing else is said about the line
  bool sure = true;                ///< nothing else can have been meant
  bool open = false;               ///< a block still lacks its end, or an end its block
  std::size_t errors = 0;

  /// Whether no other line can do more.
  bool settles() const { return quiet && !open; }
};

/// The text around a line, as far as it has been mended already.
struct Context {
  std::string above;
  std::string below; ///< from the end of the line on
};

/// The search for what one line was meant to be.
class LineRepair {
public:
  LineRepair(const Source& source, const Judge& judge, const Scenery& scenery, std::uint32_t line,
             const Context& context, const std::vector<Diagnostic>& before, int most_checks);

  /// The lines to write, the best first: one where it is clear, two where it is not.
  std::vector<Accepted> find(const Diagnostic& finding);

  /// What to do where there is no line to write.
  Message advice() const;

  /// The line as the fix of a finding leaves it; nothing where the fix goes beyond the line.
  std::optional<std::string> fixed(const Diagnostic& finding) const;

  int checks() const { return checks_; } ///< of the whole text, so far
  std::uint32_t begin() const { return begin_; }
  std::string_view line() const { return line_; }
  /// A line as it is shown: with its comment only where that changes.
  std::string shown(std::string_view text) const;

private:
  /// Whether it is a line of a program, numbered or structured.
  bool is_program() const {
    return judge_.language == Language::Basic || judge_.language == Language::Structured;
  }
  void canonical();
  bool ends_in_name(const Token& text) const;
  void part_line();
  void part_glued();
  void part_for();
  void part_next();
  void close_text();
  void truths();
  void read_logo();
  void drop_colons();
  void read_branches();
  void read_hexadecimal();
  bool is_variable(const Token& token) const;
  std::ptrdiff_t count_of(std::string_view sign) const;
  void read_shifted();
  void close_by_key();
  void comma_for_point();
  void join_words();
  void decimal_comma();
  void missed_sign(std::size_t at);
  void missed_else();
  void read_missed();
  void drop_types();
  void read_thousands();
  void drop_small_words();
  void read_zeros();
  void single_letters();
  void drop_pronoun(const Scenery& scenery);
  void drop_brackets();
  void without_accents();
  void numbers_in_quotes();
  void names_in_quotes();
  void plain_signs();
  void count_percents();
  void same_letters();
  void drop_prefixes();
  void drop_objects();
  bool is_misspelt(std::string_view word) const;
  void other_forms();
  void drop_sigils();
  void index_arrays(const Scenery& scenery);
  void resolve_labels(const Scenery& scenery);
  std::string whole(std::string_view statement) const;
  std::string several(std::string_view statements) const;
  std::string spelled(const std::string& statements, int depth) const;
  std::string declared_otherwise(const std::string& statement) const;
  bool sets_name() const;
  bool adds_condition(std::string_view statement) const;
  bool keeps_names(std::string_view statement) const;
  bool keeps_functions(std::string_view lines) const;
  bool joins_numbers(std::string_view lines) const;
  bool invents_macro(std::string_view statement) const;
  bool keeps_operands(std::string_view statement) const;
  bool keeps_meaning(std::string_view statement) const;
  bool attempt(const std::string& statement, const orb::Text* note, bool sure);
  bool parses(std::string_view lines) const;
  bool keeps_texts(std::string_view lines) const;
  bool calls_with_name() const;
  bool keeps_leaving(std::string_view lines) const;
  std::size_t errors_of(const std::vector<Diagnostic>& findings, std::string_view text) const;
  std::optional<Accepted> attempt_line(const std::string& text, const orb::Text* note, bool sure,
                                       bool keep = true);
  std::string with_bracket() const;
  std::optional<int> cost_of_texts(std::string_view statement) const;
  std::vector<std::string> with_one_quote() const;
  bool is_foreign(std::string_view line) const;
  bool is_unknown(const Token& token) const;
  bool rephrase(const Tokens& line);
  bool begins_alike(std::string_view lines) const;
  void habits(const std::string& statement, Bounds bounds);
  void own_call(const std::string& statement);
  void name_command();
  std::vector<Accepted> offers() const;
  void own_words();
  void own_sub();
  void several_lines(const std::string& statement);
  void by_gist();
  void among_unknown();
  void one_by_one();
  void by_words_left_out();
  std::optional<Accepted> in_milliseconds();
  void by_initials();
  void by_leaving_out();
  void by_fix(const Diagnostic& finding);
  void by_changes(int most);

  const Judge& judge_;
  std::string_view line_;
  std::uint32_t begin_;
  const Context& context_;
  std::size_t errors_ = 0;
  std::size_t lasting_; ///< errors that no fix mends by itself
  SplitLine parts_;
  Surroundings around_;
  std::vector<std::string_view> names_;
  std::vector<std::string_view> letters_; ///< of orbBasic: that other lines use
  std::string number_below_;
  std::string sub_;             ///< of the program, which the line calls, rightly or not
  std::string like_;            ///< the sub whose name means what the first word says
  std::string meant_;           ///< the sub that a call of an unknown one can only mean
  bool is_target_;              ///< something jumps here
  bool misplaced_ = false;      ///< it has nothing to leave
  bool guessed_ = false;        ///< a sign or a word was put in that lacks
  std::vector<Candidate> near_; ///< by one change, the cheapest first
  std::unordered_set<std::string> seen_;
  mutable Rewrites rewrites_; ///< of this line, and what became of it
  std::unordered_set<std::string> changed_;
  std::optional<Accepted> best_;
  std::optional<Accepted> other_;
  int most_checks_;
  int checks_ = 0;
};

} // namespace orb::repair
