#include "repair/repair.h"

#include "base/fixes.h"
#include "base/text.h"
#include "repair/blocks.h"
#include "repair/idioms.h"
#include "repair/scenery.h"
#include "repair/search.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>

namespace orb::repair {
namespace {

constexpr std::size_t most_bytes = 65536; // more than any area of the robot holds
constexpr std::size_t most_lines = 12;    // with errors; nobody reads more at once
constexpr std::size_t most_states = 150;  // of one line, by habits
constexpr int most_candidates = 1000;     // of one line, by search
constexpr int most_checks = 16;           // of the whole text, for one line
constexpr int deepest = 6;                // habits in one line
constexpr int surely = 6;                 // one letter of a word
constexpr int clearly = 4;                // by so much the best change is cheaper than the next

std::size_t errors_in(const std::vector<Diagnostic>& findings) {
  return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(), is_error));
}

/// Errors that no fix mends by itself.
std::size_t lasting_errors(const std::vector<Diagnostic>& findings) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [](const Diagnostic& one) {
        return is_error(one) && !(one.fix && one.fix->safety == Safety::Safe);
      }));
}

/// A line that was tried in its place.
struct Accepted {
  std::string text; ///< of the whole line
  std::string_view note;
  bool fewer = false; ///< the text has fewer errors with it
  bool quiet = false; ///< nothing else is said about the line
  bool sure = true;   ///< nothing else can have been meant
  bool open = false;  ///< a block still lacks its end, or an end its block
  std::size_t errors = 0;

  /// Whether no other line can do more.
  bool settles() const { return quiet && !open; }
};

/// The text around a line, as far as it has been mended already.
struct Context {
  std::string above;
  std::string below;
};

/// The search for one line.
class Repair {
public:
  Repair(const Source& source, const Judge& judge, const Scenery& scenery, std::uint32_t line,
         const Context& context, const std::vector<Diagnostic>& before)
      : judge_(judge), line_(source.line(line)), begin_(source.line_start(line)), context_(context),
        errors_(errors_in(before)), lasting_(lasting_errors(before)),
        parts_(split(line_, judge.language)), around_(scenery.around(line, parts_)),
        names_(scenery.names_without(parts_.tokens)),
        is_target_(judge.language == Language::Basic &&
                   !scenery.jumps_to(scenery.number(line)).empty()) {
    if (judge.language == Language::Basic)
      around_.names = scenery.set_without(parts_.tokens);
    for (const auto name : names_)
      if (std::none_of(judge.words.begin(), judge.words.end(),
                       [&](std::string_view word) { return equal_words(word, name); }))
        around_.names.push_back(name);
    canonical();
    if (judge.language == Language::Basic)
      resolve_labels(scenery);
  }

  /// The lines to write, the best first: one where it is clear, two where it is not.
  std::vector<Accepted> find(const Diagnostic& finding) {
    if (parts_.tokens.size() > most_tokens)
      return {};
    const auto start = join(parts_.tokens);
    if (finding.rule->id == "unknown-name" || finding.rule->id == "foreign-word")
      by_fix(finding); // it knows the names and the blocks
    if (!best_ && whole(start) != line_)
      attempt(start, {}, true);
    if (!best_)
      by_changes(surely);
    if (!best_ || !best_->settles())
      habits(start, {deepest, most_states});
    if (!best_ || !best_->quiet)
      by_fix(finding);
    if (!best_)
      by_changes(1000);
    std::vector<Accepted> all;
    if (best_)
      all.push_back(*best_);
    if (other_)
      all.push_back(*other_);
    return all;
  }

  /// What to do where there is no line to write.
  std::string advice() const { return advise(parts_.tokens, around_); }

  std::uint32_t begin() const { return begin_; }
  std::string_view line() const { return line_; }
  /// The line as it is shown: with its comment only where that changes.
  std::string shown(const std::string& text) const {
    auto parts = split(text, judge_.language);
    if (!parts.comment.empty() && !parts.tokens.empty() &&
        line_.find(parts.comment) != std::string_view::npos)
      parts.comment.clear();
    return std::string(trimmed(join(parts)));
  }

private:
  static std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front()))
      text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back()))
      text.remove_suffix(1);
    return text;
  }

  /// Words in their documented spelling where the robot looks at case, numbers without `0x`.
  void canonical() {
    for (auto& token : parts_.tokens) {
      if (token.is_word() && judge_.language != Language::Structured &&
          std::find(judge_.words.begin(), judge_.words.end(), token.text) == judge_.words.end()) {
        const auto same =
            std::find_if(judge_.words.begin(), judge_.words.end(), [&](std::string_view one) {
              return one.size() > 1 && equal_words(one, token.text);
            });
        if (same != judge_.words.end())
          token.text = *same;
      }
      if (token.is_number() && judge_.language == Language::Basic && token.text.size() > 2 &&
          to_lower(token.text[1]) == 'x')
        if (const auto value =
                parse_number<std::int32_t>(std::string_view(token.text).substr(2), 16))
          token.text = std::to_string(*value);
    }
  }

  /// Jumps to labels, as other languages have them, become jumps to their lines.
  void resolve_labels(const Scenery& scenery) {
    auto& tokens = parts_.tokens;
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
      const bool jumps =
          equal_words(tokens[i].text, "goto") || equal_words(tokens[i].text, "gosub");
      if (!jumps || !tokens[i + 1].is_word())
        continue;
      if (const auto number = scenery.number_of(tokens[i + 1].text); !number.empty())
        tokens[i + 1].text = number;
    }
  }

  std::string whole(const std::string& statement) const {
    if (statement.empty() && parts_.comment.empty())
      return {};
    auto text = parts_.head + statement;
    if (!parts_.comment.empty())
      text += (statement.empty() ? "" : " ") + parts_.comment;
    return text;
  }

  /// Tries a line in its place; true when it cannot be better.
  bool attempt(const std::string& statement, std::string_view note, bool sure) {
    return attempt_line(whole(statement), note, sure).has_value() && best_ && best_->settles();
  }

  std::optional<Accepted> attempt_line(const std::string& text, std::string_view note, bool sure,
                                       bool keep = true) {
    if (text == line_ || checks_ >= most_checks || !judge_.parses(text))
      return std::nullopt;
    ++checks_;
    auto changed = context_.above;
    const auto begin = changed.size();
    // What jumps to a line that is left out goes on below it, as it would after one that does
    // nothing.
    changed += text.empty() && is_target_ ? parts_.head + "A = A" : text;
    changed += context_.below;
    const auto found = judge_.check(changed);
    bool quiet = true;
    bool open = false;
    for (const auto& one : found) {
      open = open || one.rule->id == "unclosed-block" || one.rule->id == "block-end";
      if (one.span.begin < begin || one.span.begin > begin + text.size())
        continue;
      if (is_error(one) && one.rule->id != "unclosed-block")
        return std::nullopt;
      quiet = quiet && one.severity == Severity::Info;
    }
    const auto errors = errors_in(found);
    if (errors > errors_ || (!keep && errors == errors_))
      return std::nullopt;
    Accepted accepted{text,  note, errors < errors_ || lasting_errors(found) < lasting_,
                      quiet, sure, open,
                      errors};
    if (keep &&
        (!best_ || errors < best_->errors || (errors == best_->errors && quiet && !best_->quiet)))
      best_ = accepted;
    return accepted;
  }

  /// Applies habits until the line is one.
  void habits(const std::string& statement, Bounds bounds) {
    explore(statement, around_, bounds, seen_,
            [&](const Rewritten& one) { return attempt(one.text, one.note, one.sure); });
  }

  /// What the language itself offers.
  void by_fix(const Diagnostic& finding) {
    if (!finding.fix || finding.fix->edits.empty())
      return;
    std::string text(line_);
    for (auto edit = finding.fix->edits.rbegin(); edit != finding.fix->edits.rend(); ++edit) {
      if (edit->span.begin < begin_ || edit->span.end > begin_ + line_.size())
        return;
      text.replace(edit->span.begin - begin_, edit->span.size(), edit->text);
    }
    if (text.find('\n') == std::string::npos)
      attempt_line(text, {}, finding.fix->safety == Safety::Safe);
  }

  /// The nearest line; two where it is not clear which.
  void by_changes(int most) {
    auto first = changes(parts_.tokens, judge_.language, judge_.words, names_);
    std::erase_if(first, [&](const Candidate& one) { return one.cost > most; });
    std::vector<std::pair<Candidate, Accepted>> good;
    int tried = 0;
    const auto consider = [&](const Candidate& one) {
      if (!good.empty() && one.cost > good.front().first.cost + clearly)
        return;
      if (++tried > most_candidates || good.size() > 1 || !changed_.insert(one.text).second)
        return;
      if (auto accepted = attempt_line(whole(one.text), {}, one.cost <= 9, false)) {
        good.emplace_back(one, *std::move(accepted));
        return;
      }
      if (one.cost >= 10 || !good.empty() || most == surely)
        return;
      // a misspelt habit
      best_.reset();
      habits(one.text, {3, seen_.size() + 20});
      if (best_)
        good.emplace_back(one, *best_);
      best_.reset();
    };
    for (const auto& one : first)
      consider(one);
    if (good.empty() && most > surely)
      for (const auto& one : first) {
        if (one.cost > 9 || tried > most_candidates)
          break;
        for (auto next :
             changes(tokens_of(one.text, judge_.language), judge_.language, judge_.words, names_)) {
          next.cost += one.cost;
          if (next.cost > 18)
            break;
          consider(next);
        }
      }
    if (!good.empty())
      best_ = good[0].second;
    if (good.size() > 1)
      other_ = good[1].second;
  }

  const Judge& judge_;
  std::string_view line_;
  std::uint32_t begin_;
  const Context& context_;
  std::size_t errors_;
  std::size_t lasting_;
  SplitLine parts_;
  Surroundings around_;
  std::vector<std::string_view> names_;
  bool is_target_; ///< something jumps here
  std::unordered_set<std::string> seen_;
  std::unordered_set<std::string> changed_;
  std::optional<Accepted> best_;
  std::optional<Accepted> other_;
  int checks_ = 0;
};

/// The change from one line to another, as small as it is.
Edit difference(std::string_view from, std::string_view to, std::uint32_t begin) {
  std::size_t left = 0;
  while (left < from.size() && left < to.size() && from[left] == to[left])
    ++left;
  std::size_t right = 0;
  while (right < from.size() - left && right < to.size() - left &&
         from[from.size() - 1 - right] == to[to.size() - 1 - right])
    ++right;
  return {{begin + static_cast<std::uint32_t>(left),
           begin + static_cast<std::uint32_t>(from.size() - right)},
          std::string(to.substr(left, to.size() - left - right))};
}

/// A name that is nowhere defined because its definition is misspelt: the definition is mended.
bool mend_definition(const Source& source, const Judge& judge, const Scenery& scenery,
                     const std::vector<Diagnostic>& before, Diagnostic& finding) {
  const auto word = source.text(finding.span);
  const auto other = scenery.misspelt(word, judge.words);
  if (!other)
    return false;
  for (std::uint32_t n = 1; n <= source.line_count(); ++n)
    for (const auto& token : split(source.line(n), judge.language).tokens) {
      if (!token.is_word() || token.text != *other)
        continue;
      const auto begin = source.line_start(n) + token.at;
      const Edit edit{{begin, begin + static_cast<std::uint32_t>(other->size())},
                      std::string(word)};
      auto text = std::string(source.text());
      text.replace(begin, other->size(), word);
      if (errors_in(judge.check(text)) >= errors_in(before))
        return false;
      auto line = std::string(source.line(n));
      line.replace(token.at, other->size(), word);
      finding.help =
          fmt::format("write `{}` in line {}", line.substr(line.find_first_not_of(" \t")), n);
      finding.fix = Fix{fmt::format("rename `{}` to `{}`", *other, word), {edit}, Safety::Unsafe};
      return true;
    }
  return false;
}

/// Whether a finding is about how its line is written: a line that parses is only looked at where a
/// word in it means nothing, and a fix of several lines knows better.
bool is_about_writing(const Diagnostic& finding, const Source& source, const Judge& judge,
                      std::uint32_t line) {
  const auto text = source.line(line);
  const Span span{source.line_start(line),
                  source.line_start(line) + static_cast<std::uint32_t>(text.size())};
  if (finding.fix && finding.fix->safety == Safety::Safe)
    for (const auto& edit : finding.fix->edits)
      if (edit.span.begin < span.begin || edit.span.end > span.end ||
          edit.text.find('\n') != std::string::npos)
        return false;
  if ((judge.language != Language::Basic && judge.language != Language::Structured) ||
      !judge.parses(text))
    return true;
  constexpr auto unknown = std::to_array<std::string_view>(
      {"unknown-name", "wrong-use", "argument-count", "foreign-word", "reserved-name",
       "condition-as-value", "bad-number"});
  return std::find(unknown.begin(), unknown.end(), finding.rule->id) != unknown.end();
}

/// Whether a finding only says that the line does not parse.
bool says_little(const Diagnostic& finding) {
  constexpr auto rules = std::to_array<std::string_view>(
      {"syntax-error", "unknown-statement", "unknown-name", "foreign-word", "malformed-line"});
  return !finding.fix && std::find(rules.begin(), rules.end(), finding.rule->id) != rules.end();
}

/// Whether a line goes on in the next one, or seems to: an operator or a bracket is left open.
bool goes_on(std::string_view line) {
  int depth = 0;
  const auto tokens = split(line.substr(0, longest_line), Language::Structured).tokens;
  for (const auto& token : tokens)
    depth += token.is("(") || token.is("[") ? 1 : token.is(")") || token.is("]") ? -1 : 0;
  return depth > 0 ||
         (!tokens.empty() && tokens.back().kind == Token::Kind::Sign && !tokens.back().is(")"));
}

} // namespace

namespace {

/// Offers lines for the findings of one text.
class Offers {
public:
  Offers(std::string_view text, const Judge& judge, std::vector<Diagnostic>& findings)
      : source_({}, std::string(text)), judge_(judge), findings_(findings), before_(findings),
        scenery_(source_, judge.language) {}

  void make() {
    if (judge_.language == Language::Basic)
      blocks();
    // From the last line up: what ends a block is mended before what begins it is judged.
    std::vector<Diagnostic*> first;
    for (auto& finding : findings_)
      if (is_error(finding) && finding.span.begin <= source_.text().size() &&
          first.size() < most_lines && is_to_mend(finding))
        first.push_back(&finding);
    std::stable_sort(first.begin(), first.end(), [](const Diagnostic* a, const Diagnostic* b) {
      return a->span.begin > b->span.begin;
    });
    for (auto* finding : first)
      offer(*finding);
    if (judge_.language == Language::Structured)
      offer_again(first);
    drop_consequences();
  }

private:
  Span span_of(std::uint32_t line) const {
    const auto begin = source_.line_start(line);
    return {begin, begin + static_cast<std::uint32_t>(source_.line(line).size())};
  }
  std::uint32_t line_of(const Diagnostic& finding) const {
    return source_.position(finding.span.begin).line;
  }

  /// Blocks of several lines, each with one fix at all of its findings.
  void blocks() {
    for (const auto& block : blocks_as_jumps(source_, scenery_, judge_.parses)) {
      const Fix fix{"write jumps for the block", block.edits, Safety::Safe};
      Diagnostic all;
      all.fix = fix;
      if (errors_in(judge_.check(apply_fixes(source_.text(), {all}).text)) >= errors_in(before_))
        continue;
      for (auto& finding : findings_) {
        const auto written = block.lines.find(line_of(finding));
        if (!is_error(finding) || written == block.lines.end() ||
            !lines_.insert(written->first).second)
          continue;
        finding.help = written->second.empty() ? "leave the line out"
                                               : fmt::format("write `{}`", written->second);
        finding.fix = fix;
        mended_.insert(&finding);
      }
    }
  }

  /// Whether a finding is the first of a line that another could be written for.
  bool is_to_mend(const Diagnostic& finding) {
    const auto line = line_of(finding);
    return !source_.line(line).empty() && source_.line(line).size() <= longest_line &&
           (is_about_writing(finding, source_, judge_, line) || continues(line)) &&
           lines_.insert(line).second;
  }

  /// Whether a line seems to go on from the one above.
  bool continues(std::uint32_t line) const {
    return judge_.language == Language::Structured && line > 1 && goes_on(source_.line(line - 1));
  }

  void offer(Diagnostic& finding) {
    if ((finding.rule->id == "unknown-name" || finding.rule->id == "foreign-word") &&
        mend_definition(source_, judge_, scenery_, before_, finding)) {
      mended_.insert(&finding);
      return;
    }
    auto at = line_of(finding);
    const bool here = is_about_writing(finding, source_, judge_, at);
    Context context;
    std::optional<Repair> repair;
    const auto found_at = [&] {
      context = around(at);
      repair.emplace(source_, judge_, scenery_, at, context, before(at, context));
      return repair->find(finding);
    };
    auto found = here ? found_at() : std::vector<Accepted>();
    if (found.empty() && continues(at) && lines_.insert(at - 1).second) {
      --at;
      found = found_at();
      if (!found.empty())
        finding.span = span_of(at);
    }
    if (!found.empty()) {
      write(finding, *repair, at, found);
      mended_.insert(&finding);
      if (found.size() == 1 && (found[0].fewer || found[0].open))
        texts_[at] = found[0].text;
    } else if (repair && says_little(finding)) {
      if (auto advice = repair->advice(); !advice.empty())
        finding.help = std::move(advice);
    }
  }

  /// What a block begins with may have been mended after what is in it: from the first line down,
  /// each line is judged once more among the others.
  void offer_again(const std::vector<Diagnostic*>& findings) {
    if (texts_.empty() || errors_in(judge_.check(whole_text())) == 0)
      return;
    for (auto finding = findings.rbegin(); finding != findings.rend(); ++finding) {
      const auto& first = before_[static_cast<std::size_t>(*finding - findings_.data())];
      const auto at = line_of(first);
      if (!is_about_writing(first, source_, judge_, at))
        continue;
      const auto context = around(at);
      const auto before =
          findings_about(context.above + std::string(source_.line(at)) + context.below);
      Repair repair(source_, judge_, scenery_, at, context, before);
      const auto found = repair.find(first);
      if (found.size() != 1 || !(found[0].fewer || found[0].open) ||
          (texts_.contains(at) && texts_[at] == found[0].text))
        continue;
      **finding = first;
      write(**finding, repair, at, found);
      mended_.insert(*finding);
      texts_[at] = found[0].text;
    }
  }

  /// Lines from `from` to before `to`, those that are mended as they will be, each with its end.
  std::string lines(std::uint32_t from, std::uint32_t to) const {
    std::string text;
    for (auto n = from; n < to; ++n) {
      const auto mended = texts_.find(n);
      const auto end = span_of(n).end;
      text += mended != texts_.end() ? std::string_view(mended->second) : source_.line(n);
      text += source_.text().substr(end, source_.line_start(n + 1) - end);
    }
    return text;
  }
  std::string whole_text() const { return lines(1, source_.line_count() + 1); }

  Context around(std::uint32_t line) const {
    const auto end = span_of(line).end;
    return {lines(1, line),
            std::string(source_.text().substr(end, source_.line_start(line + 1) - end)) +
                lines(line + 1, source_.line_count() + 1)};
  }

  std::vector<Diagnostic> findings_about(const std::string& text) const {
    return text == source_.text() ? before_ : judge_.check(text);
  }
  std::vector<Diagnostic> before(std::uint32_t line, const Context& context) const {
    return texts_.empty()
               ? before_
               : findings_about(context.above + std::string(source_.line(line)) + context.below);
  }

  /// Errors that are not there once the lines are written that are offered elsewhere: an `end`
  /// whose block begins in another language.
  void drop_consequences() {
    std::vector<Diagnostic> offered;
    for (const auto& finding : findings_)
      if (finding.fix && mended_.contains(&finding))
        offered.push_back(finding);
    if (offered.empty() || offered.size() == errors_in(findings_))
      return;
    for (auto& one : offered)
      one.fix->safety = Safety::Safe; // as all are taken
    const Source then({}, apply_fixes(source_.text(), offered).text);
    const auto after = judge_.check(then.text());
    if (std::any_of(after.begin(), after.end(), [&](const Diagnostic& one) {
          return is_error(one) &&
                 std::none_of(before_.begin(), before_.end(), [&](const auto& was) {
                   return was.rule == one.rule && was.message == one.message;
                 });
        }))
      return; // what was offered does not go far enough to tell
    std::set<const Diagnostic*> gone;
    for (const auto& finding : findings_)
      if (is_error(finding) && !finding.fix && !mended_.contains(&finding) &&
          std::none_of(after.begin(), after.end(), [&](const Diagnostic& one) {
            return is_error(one) && ((one.rule == finding.rule && one.message == finding.message) ||
                                     then.line(then.position(one.span.begin).line) ==
                                         source_.line(line_of(finding)));
          }))
        gone.insert(&finding);
    std::erase_if(findings_, [&](const Diagnostic& one) { return gone.contains(&one); });
  }

  void write(Diagnostic& finding, const Repair& repair, std::uint32_t at,
             const std::vector<Accepted>& found) const {
    const auto shown = repair.shown(found[0].text);
    if (found.size() > 1) {
      finding.help = fmt::format("write `{}` or `{}`", shown, repair.shown(found[1].text));
      finding.fix.reset();
      return;
    }
    finding.help = shown.empty() ? "leave the line out" : fmt::format("write `{}`", shown);
    if (!found[0].note.empty())
      finding.help += fmt::format("; {}", found[0].note);
    if (finding.fix && finding.fix->safety == Safety::Safe)
      return; // its own fix goes as far as it must
    const auto safety = found[0].fewer && found[0].sure ? Safety::Safe : Safety::Unsafe;
    if (shown.empty() && repair.line().find_first_not_of(" \t") != std::string_view::npos) {
      finding.fix = remove(at, safety);
      if (finding.fix && finding.fix->edits[0].text.ends_with("end"))
        finding.help = fmt::format("write `{}`", finding.fix->edits[0].text);
      return;
    }
    finding.fix = Fix{shown.empty() ? "empty the line" : fmt::format("write `{}`", shown),
                      {difference(repair.line(), found[0].text, repair.begin())},
                      safety};
  }

  /// Removes a line; what jumps to it then jumps to the next one, or to an `end` in its place.
  std::optional<Fix> remove(std::uint32_t line, Safety safety) const {
    Fix fix{"remove the line", {}, safety};
    const auto number = judge_.language == Language::Basic ? scenery_.number(line) : std::string();
    const auto jumps = number.empty() ? std::vector<Span>() : scenery_.jumps_to(number);
    const auto next = jumps.empty() ? std::string() : scenery_.number_below(line);
    if (!jumps.empty() && next.empty()) {
      fix.title = "end here";
      fix.edits.push_back({span_of(line), number + " end"});
      return fix;
    }
    for (const auto& jump : jumps)
      if (source_.position(jump.begin).line != line)
        fix.edits.push_back({jump, next});
    fix.edits.push_back({{source_.line_start(line), source_.line_start(line + 1)}, {}});
    std::sort(fix.edits.begin(), fix.edits.end(),
              [](const Edit& a, const Edit& b) { return a.span.begin < b.span.begin; });
    return fix;
  }

  const Source source_;
  const Judge& judge_;
  std::vector<Diagnostic>& findings_;
  const std::vector<Diagnostic> before_;
  Scenery scenery_;
  std::set<std::uint32_t> lines_;              ///< looked at
  std::set<const Diagnostic*> mended_;         ///< of `findings_`: with what is offered here
  std::map<std::uint32_t, std::string> texts_; ///< of lines, as they are mended
};

} // namespace

void offer_lines(std::string_view text, const Judge& judge, std::vector<Diagnostic>& findings) {
  if (text.size() <= most_bytes && errors_in(findings) > 0)
    Offers(text, judge, findings).make();
}

} // namespace orb::repair
