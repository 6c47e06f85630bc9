#pragma once

// Private to repair/.

#include "repair/idioms.h"
#include "repair/line.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace orb::repair {

std::size_t errors_in(const std::vector<Diagnostic>& findings);

/// Whether a finding is about a word that means nothing.
bool is_unknown(const Diagnostic& finding);
bool is_unclosed(const Diagnostic& finding);
bool is_block_end(const Diagnostic& finding);

/// The text around a line, as far as it has been mended already.
struct Context {
  std::string above;
  std::string below; ///< from the end of the line on
};

/// Lines that were checked in the place of one.
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

/// Checks candidates for one line with the whole text, within a budget, and ranks them: fewer
/// errors first, then fewer findings, then the one that was offered first.
class Trial {
public:
  /// `before` are the findings about the text as it is; `budget` is how often it may be checked.
  Trial(const Line& line, const Diagnostic& finding, const Context& context,
        const std::vector<Diagnostic>& before, int budget);

  const Line& line() const { return line_; }
  const Diagnostic& finding() const { return finding_; }
  int left() const { return left_; } ///< checks

  /// Tries statements in the place of the line's; true when none can do better.
  bool offer(const Candidate& candidate);
  /// Tries whole lines, and keeps them where they are the best.
  std::optional<Accepted> offer_lines(const Candidate& candidate);
  /// Tries whole lines that leave fewer errors; the best stays what it was.
  std::optional<Accepted> check(const Candidate& candidate);
  /// Tries a statement as what may have been meant as well.
  void offer_other(const std::string& statement);

  /// Tries a declaration by its other word; unsure.
  void offer_declared_otherwise(const std::string& statement);

  /// The step that the candidates are of from now on, as --explain-repairs names it.
  void begin(std::string_view origin) { origin_ = origin; }

  bool found() const { return best_.has_value(); }
  bool settled() const { return best_ && best_->settles(); }
  std::optional<Accepted>& best() { return best_; }
  std::optional<Accepted>& other() { return other_; }
  /// The best lines, the likeliest first: one where it is clear, two where it is not.
  std::vector<Accepted> offers() const;
  /// All that were checked, for people who want to know why.
  std::vector<Considered>& considered() { return considered_; }

  /// The rows that fit a line, one alone first, until `take` is true; what was seen stays known.
  void explore_rows(const std::string& statement, Bounds bounds,
                    std::unordered_set<std::string>& seen,
                    const std::function<bool(const Candidate&)>& take);
  std::unordered_set<std::string>& seen() { return seen_; }

  /// Small changes of the line, the cheapest first, and those that were looked at.
  struct Changes {
    std::vector<Candidate> near;
    std::unordered_set<std::string> seen;
  };
  Changes& changes() { return changes_; }

private:
  bool parses(std::string_view lines) const;
  std::string spelled(const std::string& statements, int depth);
  std::string several(std::string_view statements) const;
  std::string declared_otherwise(const std::string& statement) const;
  std::size_t errors_of(const std::vector<Diagnostic>& findings, std::string_view text) const;
  std::optional<Accepted> look(const Candidate& candidate);

  const Line& line_;
  const Diagnostic& finding_;
  const Context& context_;
  std::size_t errors_ = 0;
  std::size_t lasting_ = 0; ///< errors that no fix mends by itself
  int left_;
  std::string_view origin_;
  std::optional<Accepted> best_;
  std::optional<Accepted> other_;
  std::vector<Considered> considered_;
  std::unordered_set<std::string> seen_;
  Changes changes_;
  Rewrites rewrites_; ///< of this line, and what became of it
};

/// The lines to write for the line of a trial; empty where nobody can know.
std::vector<Accepted> mend(Trial& trial);

/// The line as its finding's own fix leaves it; nothing where the fix goes beyond the line.
std::optional<std::string> fixed(const Line& line, const Diagnostic& finding);

/// A line as it is shown: with its comment only where that changes.
std::string shown(const Line& line, std::string_view text);

} // namespace orb::repair
