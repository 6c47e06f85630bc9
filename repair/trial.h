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

/// True if a finding is about an unknown word.
bool is_unknown(const Diagnostic& finding);
bool is_unclosed(const Diagnostic& finding);
bool is_block_end(const Diagnostic& finding);

/// The text around a line, with the repairs made so far.
struct Context {
  std::string above;
  std::string below; ///< from the end of the line on
};

/// Checked replacement lines for one line.
struct Accepted {
  std::string text;                ///< the whole line; of several, all but the last end with `\n`
  const orb::Text* note = nullptr; ///< the reason; null: none is shown
  bool fewer = false;              ///< it reduces the number of errors
  bool quiet = false;              ///< no other finding on the line
  bool sure = true;                ///< no other meaning is possible
  bool open = false;               ///< a block still lacks its end, or an end its block
  std::size_t errors = 0;

  /// True if no other line can be better.
  bool settles() const { return quiet && !open; }
};

/// Checks candidates for one line with the whole text, within a budget, and ranks them: fewer
/// errors, then fewer findings, then order of proposal. Large because all repairs of a line share
/// its budget, its best candidates and the record of what was tried.
class Trial {
public:
  /// `before` are the findings about the original text; `budget` is the number of checks allowed.
  Trial(const Line& line, const Diagnostic& finding, const Context& context,
        const std::vector<Diagnostic>& before, int budget);

  const Line& line() const { return line_; }
  const Diagnostic& finding() const { return finding_; }
  int left() const { return left_; } ///< remaining checks

  /// Tries statements in place of the line's; returns true if nothing can be better.
  bool offer(const Candidate& candidate);
  /// Tries whole lines, and keeps them if they are the best.
  std::optional<Accepted> offer_lines(const Candidate& candidate);
  /// Tries whole lines that reduce the errors; does not change the best.
  std::optional<Accepted> check(const Candidate& candidate);
  /// Tries a statement as an alternative meaning.
  void offer_other(const std::string& statement);

  /// Tries a declaration with its alternative keyword, marked unsure.
  void offer_declared_otherwise(const std::string& statement);

  /// Names the step for the following candidates, as in --explain-repairs.
  void begin(std::string_view origin) { origin_ = origin; }

  bool found() const { return best_.has_value(); }
  bool settled() const { return best_ && best_->settles(); }
  std::optional<Accepted>& best() { return best_; }
  std::optional<Accepted>& other() { return other_; }
  /// The best lines, the likeliest first: one if it is clear, else two.
  std::vector<Accepted> offers() const;
  /// All checked candidates, for --explain-repairs.
  std::vector<Considered>& considered() { return considered_; }

  /// Explores rows for a line, single ones first, until `take` returns true; `seen` is kept.
  void explore_rows(const std::string& statement, Bounds bounds,
                    std::unordered_set<std::string>& seen,
                    const std::function<bool(const Candidate&)>& take);
  std::unordered_set<std::string>& seen() { return seen_; }

  /// Small changes of the line, the cheapest first, and those already examined.
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
  std::size_t lasting_ = 0; ///< errors without a safe fix
  int left_;
  std::string_view origin_;
  std::optional<Accepted> best_;
  std::optional<Accepted> other_;
  std::vector<Considered> considered_;
  std::unordered_set<std::string> seen_;
  Changes changes_;
  Rewrites rewrites_; ///< of this line, with their results
};

/// The replacement lines for a trial; empty if the intent is unclear.
std::vector<Accepted> mend(Trial& trial);

/// The line after its finding's own fix; nothing if the fix extends beyond the line.
std::optional<std::string> fixed(const Line& line, const Diagnostic& finding);

/// A line for display: its comment only if that changes.
std::string shown(const Line& line, std::string_view text);

} // namespace orb::repair
