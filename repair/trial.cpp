#include "repair/trial.h"

#include "base/text/text.h"
#include "repair/keeping.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::repair {
namespace {

constexpr std::size_t states_of_several = 40; // of one line, by rows with several lines
constexpr std::uint32_t usual_step = 10;      // of line numbers

/// Errors without a safe fix of their own.
std::size_t lasting_errors(const std::vector<Diagnostic>& findings) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [](const Diagnostic& one) {
        return keeps_from_building(one) && !(one.fix && one.fix->safety == Safety::Safe);
      }));
}

} // namespace

std::size_t errors_in(const std::vector<Diagnostic>& findings) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), keeps_from_building));
}

bool is_unknown(const Diagnostic& finding) {
  return finding.rule->trouble == Trouble::UnknownName ||
         finding.rule->trouble == Trouble::ForeignWord;
}
bool is_unclosed(const Diagnostic& finding) {
  return finding.rule->trouble == Trouble::UnclosedBlock;
}
bool is_block_end(const Diagnostic& finding) {
  return finding.rule->trouble == Trouble::BlockEnd;
}

Trial::Trial(const Line& line, const Diagnostic& finding, const Context& context,
             const std::vector<Diagnostic>& before, int budget)
    : line_(line), finding_(finding), context_(context), lasting_(lasting_errors(before)),
      left_(budget) {
  errors_ = errors_of(before, context.above + std::string(line.written) + context.below);
}

std::vector<Accepted> Trial::offers() const {
  std::vector<Accepted> all;
  if (best_)
    all.push_back(*best_);
  if (other_)
    all.push_back(*other_);
  return all;
}

bool Trial::offer(const Candidate& candidate) {
  const auto& statement = candidate.text;
  if (!keeps_meaning(line_, statement))
    return false;
  const bool one = statement.find('\n') == std::string::npos;
  auto lines = candidate;
  lines.text = one ? line_.with(statement) : several(spelled(statement, 0));
  if (!one && lines.text.empty())
    return false;
  const auto accepted = offer_lines(lines);
  const bool begins = statement.starts_with("sub ") || statement.starts_with("function ");
  if (one && (accepted ? accepted->errors > 0 : begins))
    if (const auto other = declared_otherwise(statement); !other.empty()) {
      lines.text = line_.with(other);
      offer_lines(lines);
    }
  return accepted && settled();
}

std::optional<Accepted> Trial::offer_lines(const Candidate& candidate) {
  auto accepted = look(candidate);
  if (accepted && (!best_ || accepted->errors < best_->errors ||
                   (accepted->errors == best_->errors && accepted->quiet && !best_->quiet)))
    best_ = accepted;
  return accepted;
}

std::optional<Accepted> Trial::check(const Candidate& candidate) {
  auto accepted = look(candidate);
  return accepted && accepted->errors < errors_ ? accepted : std::nullopt;
}

void Trial::offer_other(const std::string& statement) {
  other_ =
      check({.text = line_.with(statement), .why = best_ ? best_->note : nullptr, .sure = false});
}

std::optional<Accepted> Trial::look(const Candidate& candidate) {
  const auto& text = candidate.text;
  // A comma at the end would be new.
  const bool goes_on = text.ends_with(',') && !trim(line_.written).ends_with(',');
  if (text == line_.written || goes_on || left_ <= 0 || !keeps_parts(line_, text) || !parses(text))
    return std::nullopt;
  --left_;
  auto& noted = considered_.emplace_back(
      Considered{shown(line_, text), origin_, candidate.cost, Considered::Effect::Worse});
  auto changed = context_.above;
  const auto begin = changed.size();
  // A jump to a removed line continues below it, as after a line without effect.
  changed += text.empty() && line_.is_target ? line_.head + "A = A" : text;
  changed += context_.below;
  const auto found = line_.dialect->check(changed);
  bool quiet = true;
  bool open = false;
  for (const auto& one : found) {
    open = open || is_unclosed(one) || is_block_end(one);
    if (one.span.begin < begin || one.span.begin > begin + text.size())
      continue;
    if (keeps_from_building(one) && !is_unclosed(one))
      return std::nullopt;
    quiet = quiet && one.severity == Severity::Info;
  }
  const auto errors = errors_of(found, changed);
  if (errors > errors_)
    return std::nullopt;
  const bool fewer = errors < errors_ || lasting_errors(found) < lasting_;
  noted.effect = fewer ? Considered::Effect::Mends : Considered::Effect::Parses;
  return Accepted{text, candidate.why, fewer, quiet, candidate.sure, open, errors};
}

/// True if each line parses on its own.
bool Trial::parses(std::string_view lines) const {
  while (!lines.empty()) {
    const auto end = lines.find_first_of("\r\n");
    if (!line_.dialect->parses(lines.substr(0, end)))
      return false;
    lines.remove_prefix(std::min(lines.find_first_not_of("\r\n", end), lines.size()));
  }
  return true;
}

/// Counts errors, except unknown names that this line does not contain: they were hidden while it
/// did not parse.
std::size_t Trial::errors_of(const std::vector<Diagnostic>& findings, std::string_view text) const {
  const auto has = [&](std::string_view word) {
    return std::any_of(line_.tokens.begin(), line_.tokens.end(),
                       [&](const Token& token) { return token.text == word; });
  };
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [&](const Diagnostic& one) {
        return keeps_from_building(one) && (one.rule->trouble != Trouble::UnknownName ||
                                            has(text.substr(one.span.begin, one.span.size())));
      }));
}

/// Spells statements in the words of the language; nothing if one has no equivalent.
std::string Trial::spelled(const std::string& statements, int depth) {
  const auto end = statements.find('\n');
  if (end != std::string::npos) {
    const auto first = spelled(statements.substr(0, end), depth);
    const auto rest = first.empty() ? first : spelled(statements.substr(end + 1), depth);
    return rest.empty() ? rest : first + '\n' + rest;
  }
  if (line_.dialect->parses(line_.head + statements))
    return statements;
  std::string found;
  std::unordered_set<std::string> seen;
  if (depth < 2)
    explore_rows(statements, {3, states_of_several}, seen, [&](const Candidate& one) {
      if (one.text.find('\n') != std::string::npos)
        found = spelled(one.text, depth + 1);
      else if (line_.dialect->parses(line_.head + one.text))
        found = one.text;
      return !found.empty();
    });
  return found;
}

/// Puts statements on separate lines; nothing if line numbers are missing.
std::string Trial::several(std::string_view statements) const {
  if (statements.empty())
    return {};
  const auto lines =
      static_cast<std::uint32_t>(std::count(statements.begin(), statements.end(), '\n') + 1);
  const auto number = parse_number<std::uint32_t>(line_.around.line_number).value_or(0);
  const auto below =
      parse_number<std::uint32_t>(line_.around.number_below).value_or(greatest_line_number);
  const bool numbered = line_.language() == Language::Basic;
  const auto step = below > number ? std::min((below - number) / lines, usual_step) : 0;
  if (numbered && step == 0)
    return {};
  auto text = line_.with(statements.substr(0, statements.find('\n')));
  for (std::uint32_t n = 1; n < lines; ++n) {
    statements.remove_prefix(statements.find('\n') + 1);
    text += line_end_of(context_.below);
    text += numbered ? std::to_string(number + n * step) + " " : line_.head;
    text += statements.substr(0, statements.find('\n'));
  }
  return text;
}

/// The same declaration with its alternative keyword: a routine without a value is a sub, one with
/// a value a function, the size of an array a constant. Empty if there is none.
std::string Trial::declared_otherwise(const std::string& statement) const {
  constexpr std::string_view function = "function ";
  constexpr std::string_view sub = "sub ";
  if (statement.starts_with(function))
    return fmt::format("{}{}", sub, statement.substr(function.size()));
  if (statement.starts_with(sub))
    return fmt::format("{}{}", function, statement.substr(sub.size()));
  const auto equals = statement.find(" = ");
  const bool sets = line_.language() == Language::Structured && line_.head.empty() &&
                    equals != std::string::npos && statement.find(' ') == equals;
  return sets ? "const " + statement : std::string();
}

void Trial::offer_declared_otherwise(const std::string& statement) {
  if (const auto other = declared_otherwise(statement); !other.empty())
    offer_lines({.text = line_.with(other), .sure = false});
}

void Trial::explore_rows(const std::string& statement, Bounds bounds,
                         std::unordered_set<std::string>& seen,
                         const std::function<bool(const Candidate&)>& take) {
  explore(statement, line_.around, bounds, seen, rewrites_, take);
}

std::optional<std::string> fixed(const Line& line, const Diagnostic& finding) {
  if (!finding.fix || finding.fix->edits.empty())
    return std::nullopt;
  std::string text(line.written);
  for (auto edit = finding.fix->edits.rbegin(); edit != finding.fix->edits.rend(); ++edit) {
    if (edit->span.begin < line.begin || edit->span.end > line.begin + line.written.size() ||
        edit->text.find('\n') != std::string::npos)
      return std::nullopt;
    text.replace(edit->span.begin - line.begin, edit->span.size(), edit->text);
  }
  return text;
}

std::string shown(const Line& line, std::string_view text) {
  auto parts = split(text, line.language());
  if (constexpr std::string_view mark = "\uFEFF"; parts.head.starts_with(mark))
    parts.head.erase(0, mark.size()); // the byte order mark
  const auto tail = text.substr(text.size() - std::min(text.size(), parts.comment.size()));
  if (!parts.comment.empty() && !parts.tokens.empty() && line.written.ends_with(tail))
    parts.comment.clear();
  return std::string(trim(join(parts)));
}

} // namespace orb::repair
