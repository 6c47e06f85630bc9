#include "repair/repair.h"

#include "base/fixes.h"
#include "base/text/text.h"
#include "repair/block_shapes.h"
#include "repair/fill.h"
#include "repair/normalise.h"
#include "repair/safety.h"
#include "repair/texts.h"
#include "repair/trial.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace orb::repair {
namespace {

constexpr std::size_t most_bytes = 65536; // more than any area of the robot holds
constexpr std::size_t most_lines = 12;    // with errors; nobody reads more at once
constexpr int most_checks = 16;           // of the whole text, for one line
constexpr int most_checks_together = 96;  // for all lines

/// The smallest edit that turns one line into another.
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

/// Repairs the misspelt definition of an undefined name.
bool mend_definition(const Source& source, const Dialect& dialect, const Scenery& scenery,
                     const std::vector<Diagnostic>& before, Diagnostic& finding) {
  const auto word = source.text(finding.span);
  auto other = scenery.misspelt(word, dialect.words);
  if (!other && dialect.language == Language::Structured) {
    const auto tokens =
        split(source.line(source.position(finding.span.begin).line), dialect.language).tokens;
    if (auto sub = scenery.sub_for(word, values_between(tokens, 1));
        !sub.empty() && !tokens.empty() && tokens[0].text == word)
      other = std::move(sub);
  }
  if (!other)
    return false;
  for (std::uint32_t n = 1; n <= source.line_count(); ++n)
    for (const auto& token : split(source.line(n), dialect.language).tokens) {
      if (!token.is_word() || token.text != *other)
        continue;
      const auto begin = source.line_start(n) + token.at;
      const Edit edit{{begin, begin + static_cast<std::uint32_t>(other->size())},
                      std::string(word)};
      auto text = std::string(source.text());
      text.replace(begin, other->size(), word);
      if (errors_in(dialect.check(text)) >= errors_in(before))
        return false;
      auto line = std::string(source.line(n));
      line.replace(token.at, other->size(), word);
      finding.help = texts::WriteOnLine(line.substr(line.find_first_not_of(" \t")), n);
      finding.fix = Fix{texts::Rename(*other, word), {edit}, Safety::Unsafe};
      return true;
    }
  return false;
}

/// True if a line that becomes several parses then.
bool parses_after(const Edit& edit, std::string_view line, Span span, const Dialect& dialect) {
  std::string text(line);
  text.replace(edit.span.begin - span.begin, edit.span.size(), edit.text);
  for (std::string_view rest = text; !rest.empty();) {
    const auto end = std::min(rest.find('\n'), rest.size());
    if (!dialect.parses(rest.substr(0, end)))
      return false;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return true;
}

bool is_one_of(const Diagnostic& finding, std::initializer_list<Trouble> troubles) {
  return std::find(troubles.begin(), troubles.end(), finding.rule->trouble) != troubles.end();
}

/// True if a line does not parse, or contains an unknown word.
bool is_malformed(const Diagnostic& finding, std::string_view line, const Dialect& dialect) {
  if (finding.rule->trouble == Trouble::Pattern)
    return false;
  if ((dialect.language != Language::Basic && dialect.language != Language::Structured) ||
      !dialect.parses(line))
    return true;
  return is_one_of(finding, {Trouble::UnknownName, Trouble::WrongValue, Trouble::ArgumentCount,
                             Trouble::ForeignWord, Trouble::ReservedName, Trouble::MalformedLine});
}

/// True if a finding concerns the notation of its line. A line that parses is repaired only if it
/// has an unknown word; a fix over several lines takes precedence.
bool is_about_writing(const Diagnostic& finding, const Source& source, const Dialect& dialect,
                      std::uint32_t line) {
  const auto text = source.line(line);
  const auto span = source.line_span(line);
  if (finding.fix)
    for (const auto& edit : finding.fix->edits)
      if (edit.span.begin < span.begin || edit.span.end > span.end ||
          (edit.text.find('\n') != std::string::npos && parses_after(edit, text, span, dialect)))
        return false;
  if (finding.span.end > span.end)
    return false; // it continues below
  return is_malformed(finding, text, dialect);
}

std::string without_blanks(std::string text) {
  std::erase_if(text, is_blank);
  return text;
}

bool is_safe(const Diagnostic& finding) {
  return finding.fix && finding.fix->safety == Safety::Safe;
}

/// True if a finding only says that the line does not parse.
bool says_little(const Diagnostic& finding) {
  return !finding.fix && is_one_of(finding, {Trouble::Unreadable, Trouble::UnknownName,
                                             Trouble::ForeignWord, Trouble::MalformedLine});
}

/// True if a help gives a replacement line.
bool says_line(const Message& help) {
  return help.is(texts::Write) || help.is(texts::WriteBecause) || help.is(texts::WriteEither) ||
         help.is(texts::WriteTwo) || help.is(texts::WriteThree);
}

/// True if a fix only deletes or inserts text, which a replacement line covers too.
bool is_piecemeal(const Fix& fix) {
  return std::all_of(fix.edits.begin(), fix.edits.end(),
                     [](const Edit& edit) { return edit.text.empty() || edit.span.size() == 0; });
}

/// True if a line seems to continue on the next one: an operator or a bracket is open.
bool goes_on(std::string_view line) {
  int depth = 0;
  const auto tokens = split(line.substr(0, longest_line), Language::Structured).tokens;
  for (const auto& token : tokens)
    depth += token.is("(") || token.is("[") ? 1 : token.is(")") || token.is("]") ? -1 : 0;
  return depth > 0 ||
         (!tokens.empty() && tokens.back().kind == Token::Kind::Sign && !tokens.back().is(")") &&
          !tokens.back().is("]") && !tokens.back().is("{") && !tokens.back().is(";"));
}

/// Proposes lines for the findings of one text. Large because each repair of several lines has its
/// own member, and each must know what the others have already repaired.
class Offers {
public:
  Offers(std::string_view text, const Dialect& dialect, std::vector<Diagnostic>& findings)
      : source_({}, std::string(text)), dialect_(dialect), findings_(findings), before_(findings),
        scenery_(source_, dialect.language), names_(defined_names(source_, dialect.language)) {}

  void make() {
    if (dialect_.language == Language::Basic)
      blocks();
    if (dialect_.language == Language::Structured)
      for (auto& finding : findings_) {
        close_block(finding);
        open_block(finding);
      }
    // Work upwards: the end of a block is repaired before its start is judged.
    std::vector<Diagnostic*> first;
    for (auto& finding : findings_)
      if (keeps_from_building(finding) && finding.span.begin <= source_.text().size() &&
          first.size() < most_lines && is_to_mend(finding))
        first.push_back(&finding);
    std::stable_sort(first.begin(), first.end(), [](const Diagnostic* a, const Diagnostic* b) {
      return a->span.begin > b->span.begin;
    });
    for (auto* finding : first)
      offer(*finding);
    if (dialect_.language == Language::Test)
      take_back({first.rbegin(), first.rend()}); // a list below `prints`, from its first text on
    if (dialect_.language == Language::Structured) {
      offer_again(first);
      close_mended();
    }
    drop_consequences();
    for (auto& finding : findings_)
      hold(finding);
  }

private:
  /// True if a replacement differs from its line only in notation.
  bool says_the_same(std::string_view line, std::string_view written) const {
    return repair::says_the_same(
        line, written,
        {dialect_.language, dialect_.words, names_, dialect_.parses,
         [this](std::string_view label) { return scenery_.number_of(label); }});
  }

  /// Marks a safe fix of the language itself as unsafe if it changes more than notation.
  void hold(Diagnostic& finding) const {
    const auto at = line_of(finding);
    std::string line(source_.line(at));
    if (!keeps_from_building(finding) || !is_safe(finding) ||
        !is_malformed(finding, line, dialect_))
      return;
    if (dialect_.language == Language::Structured && finding.rule->trouble == Trouble::ForeignWord)
      return; // the parser already reads it as the new word: the program is the same
    const auto span = source_.line_span(at);
    const auto& edits = finding.fix->edits;
    const auto parts = split(line, dialect_.language);
    const bool numbers = edits.back().span.end <= span.begin + parts.head.size() &&
                         !parts.tokens.empty() && parts.tokens[0].is_word();
    if (edits.front().span.begin < span.begin || edits.back().span.end > span.end || numbers)
      return; // over several lines, or a number for the line
    for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit)
      line.replace(edit->span.begin - span.begin, edit->span.size(), edit->text);
    if (!says_the_same(source_.line(at), line))
      finding.fix->safety = Safety::Unsafe;
  }

  std::uint32_t line_of(const Diagnostic& finding) const {
    return source_.position(finding.span.begin).line;
  }

  int checks_left() const { return std::min(most_checks, most_checks_together - checks_); }

  /// Repairs blocks over several lines, with the same fix on all of their findings.
  void blocks() {
    for (const auto& block : blocks_as_jumps(source_, scenery_, dialect_.parses)) {
      Fix fix{texts::ReplaceBlock(), block.edits, Safety::Safe};
      Diagnostic all;
      all.fix = fix;
      fix.safety = block.sure ? Safety::Safe : Safety::Unsafe;
      if (errors_in(dialect_.check(apply_fixes(source_.text(), {all}).text)) >= errors_in(before_))
        continue;
      for (auto& finding : findings_) {
        const auto written = block.lines.find(line_of(finding));
        if (!is_error(finding) || written == block.lines.end() ||
            !lines_.insert(written->first).second)
          continue;
        finding.help = in_turn(written->second, [](std::string_view line) { return line; });
        finding.fix = fix;
        mended_.insert(&finding);
      }
    }
  }

  /// True if a finding is the first of a line that may be replaced.
  bool is_to_mend(const Diagnostic& finding) {
    const auto line = line_of(finding);
    return !source_.line(line).empty() && source_.line(line).size() <= longest_line &&
           (is_about_writing(finding, source_, dialect_, line) || continues(line)) &&
           lines_.insert(line).second;
  }

  /// True if a line seems to continue the one above.
  bool continues(std::uint32_t line) const {
    return dialect_.language == Language::Structured && line > 1 && goes_on(source_.line(line - 1));
  }

  /// The nearest non-blank line; 0 if there is none.
  std::uint32_t above(std::uint32_t line) const {
    do
      --line;
    while (line > 0 && is_bare(line));
    return line;
  }
  std::uint32_t below(std::uint32_t line) const {
    do
      ++line;
    while (line <= source_.line_count() && is_bare(line));
    return line <= source_.line_count() ? line : 0;
  }
  bool is_bare(std::uint32_t line) const {
    return source_.line(line).find_first_not_of(" \t") == std::string_view::npos;
  }

  /// Joins an `if` over several lines with its statement, and its `else`, if no line ends the
  /// block.
  bool join_if(Diagnostic& finding) const {
    const auto line = line_of(finding);
    if (dialect_.language != Language::Basic)
      return false;
    const auto tokens = tokens_at(line);
    if (tokens.empty())
      return false;
    if (tokens[0].is("else"))
      return join({above(line), line}, finding) ||
             (above(line) != 0 && join_else(above(above(line)), finding));
    if (!begins_if(tokens))
      return false;
    return ends_an_if() ? join_else(line, finding) : join({line, below(line)}, finding);
  }

  /// Joins a statement with the values below it that belong to it: `rgb 255 0`, then `120`.
  bool join_values(Diagnostic& finding) {
    const auto line = line_of(finding);
    const auto next = line + 1;
    const auto is_values = [&](std::uint32_t at) {
      const auto tokens = at <= source_.line_count() ? tokens_at(at) : Tokens();
      return !tokens.empty() && std::all_of(tokens.begin(), tokens.end(), [](const Token& token) {
        return token.is_number() || token.is(",");
      });
    };
    if (dialect_.language == Language::Basic || dialect_.language == Language::Test ||
        is_values(line) || !is_values(next) || is_values(next + 1) || checks_left() <= 1)
      return false;
    const Context context{lines(1, line), "\n" + lines(next + 1, source_.line_count() + 1)};
    const Source joined({}, context.above + std::string(source_.line(line)) + " " +
                                repair::join(tokens_at(next)) + context.below);
    const auto findings = dialect_.check(joined.text());
    ++checks_;
    const auto wrong = std::find_if(findings.begin(), findings.end(), [&](const Diagnostic& one) {
      return keeps_from_building(one) && joined.position(one.span.begin).line == line;
    });
    auto text = std::string(joined.line(line));
    auto errors = errors_in(findings);
    if (wrong != findings.end()) {
      const Scenery scenery(joined, dialect_.language);
      auto whole = look_at(joined, dialect_, scenery, line);
      normalise(whole);
      auto first = *wrong;
      const auto found = mend(whole, context, findings, first);
      if (found.size() != 1)
        return false;
      text = found[0].text;
      errors = found[0].errors;
    }
    if (errors + 1 >= errors_in(before_))
      return false;
    finding.help = texts::WriteAndRemoveLine(trim(text), next);
    finding.fix = Fix{finding.help,
                      {{source_.line_span(line), text},
                       {{source_.line_start(next), source_.line_start(next + 1)}, {}}},
                      Safety::Unsafe};
    return true;
  }

  Tokens tokens_at(std::uint32_t line) const {
    const auto text = line == 0 ? std::string_view() : source_.line(line);
    return text.size() > longest_line ? Tokens() : split(text, dialect_.language).tokens;
  }

  static bool begins_if(const Tokens& tokens) {
    return tokens.size() > 2 && tokens[0].is("if") &&
           (tokens.back().is("then") || tokens.back().is(":"));
  }

  static bool is_else(const Tokens& tokens) {
    return !tokens.empty() && tokens[0].is("else") &&
           (tokens.size() == 1 || (tokens.size() == 2 && tokens[1].is(":")));
  }

  /// Joins `if … then`, a statement, `else`, and a statement that is the last one before the
  /// program ends or jumps.
  bool join_else(std::uint32_t line, Diagnostic& finding) const {
    if (line == 0 || !begins_if(tokens_at(line)))
      return false;
    const auto yes = below(line);
    const auto other = yes == 0 ? 0 : below(yes);
    const auto no = other == 0 ? 0 : below(other);
    const auto after = no == 0 ? Tokens() : tokens_at(below(no));
    const bool last = after.empty() || after[0].is("end") || after[0].is("goto") ||
                      after[0].is("next") || after[0].is("return");
    return no != 0 && last && is_else(tokens_at(other)) && !ends_an_if(other) &&
           join({line, yes, other, no}, finding);
  }

  /// True if a line other than `but` ends an `if` or its first part.
  bool ends_an_if(std::uint32_t but = 0) const {
    for (std::uint32_t n = 1; n <= source_.line_count(); ++n) {
      const auto tokens = split(source_.line(n).substr(0, longest_line), dialect_.language).tokens;
      if (n != but && !tokens.empty() &&
          (tokens[0].is("endif") || tokens[0].is("else") || tokens[0].is("}") ||
           (tokens.size() > 1 && tokens[0].is("end"))))
        return true;
    }
    return false;
  }

  /// Proposes to merge some lines into the first one.
  bool join(const std::vector<std::uint32_t>& lines, Diagnostic& finding) const {
    if (std::any_of(lines.begin(), lines.end(), [&](std::uint32_t line) {
          return line == 0 || source_.line(line).size() > longest_line ||
                 scenery_.number(line).empty();
        }))
      return false;
    auto first = split(source_.line(lines[0]), dialect_.language);
    if (first.tokens.empty() || !first.tokens[0].is("if") || !first.comment.empty())
      return false;
    if (first.tokens.back().is(":"))
      first.tokens.back() = tokens_of("then", dialect_.language)[0];
    first.tokens.back().gap = true;
    auto joined = first.head + repair::join(first.tokens);
    Fix fix{texts::RemoveLine(), {}, Safety::Unsafe};
    for (std::size_t i = 1; i < lines.size(); ++i) {
      auto tokens = tokens_at(lines[i]);
      if (is_else(tokens))
        tokens.resize(1);
      joined += " " + repair::join(tokens);
      auto removed = remove(lines[i], Safety::Unsafe);
      if (!removed)
        return false;
      fix.edits.insert(fix.edits.end(), removed->edits.begin(), removed->edits.end());
    }
    if (!dialect_.parses(joined))
      return false;
    fix.edits.push_back({source_.line_span(lines[0]), joined});
    std::sort(fix.edits.begin(), fix.edits.end(),
              [](const Edit& a, const Edit& b) { return a.span.begin < b.span.begin; });
    const auto next = scenery_.number(lines[1]);
    finding.help = lines.size() > 2
                       ? texts::WriteAndRemoveLines(joined, next, scenery_.number(lines.back()))
                   : line_of(finding) == lines[1] ? texts::WriteAndRemoveThis(joined)
                                                  : texts::WriteAndRemoveLine(joined, next);
    finding.fix = std::move(fix);
    return true;
  }

  /// True if a word is unknown only because the line that assigns or names it has an error.
  bool is_consequence(const Diagnostic& finding) const {
    if (dialect_.language != Language::Structured || !is_unknown(finding))
      return false;
    const auto word = source_.text(finding.span);
    const auto at = line_of(finding);
    return std::any_of(before_.begin(), before_.end(), [&](const Diagnostic& other) {
      if (!is_error(other) || line_of(other) == at)
        return false;
      if (other.rule->trouble == Trouble::ReservedName)
        return equal_words(source_.text(other.span), word);
      const auto tokens = tokens_at(line_of(other));
      return other.rule->trouble == Trouble::MalformedLine && tokens.size() > 1 &&
             tokens[0].is_word() && equal_words(tokens[0].text, word) && tokens[1].is("=");
    });
  }

  /// Closes a block whose last line is `while` or `loop`, as in other languages: the innermost open
  /// block begins above, and no line below is indented further.
  void close_block(Diagnostic& finding) {
    const auto line = line_of(finding);
    const auto next = below(line);
    if (!is_unclosed(finding) || (next != 0 && indent(next) > indent(line)))
      return;
    Diagnostic* open = nullptr;
    for (auto& other : findings_)
      if (is_unclosed(other) && line_of(other) < line)
        open = &other;
    if (open == nullptr)
      return;
    const auto begin = source_.line(line_of(*open));
    const auto tokens = tokens_at(line);
    const auto word = word_at(tokens_at(line_of(*open)), 0);
    const bool tests = tokens.size() > 1 && tokens[0].is("while");
    std::string text;
    if (tokens.size() == 1 && tokens[0].is("loop") && word == "while")
      text = "end while";
    else if (tests && (word == "repeat" || word == "do"))
      text = "until " + until(Tokens(tokens.begin() + 1, tokens.end()));
    const auto blanks = begin.substr(0, begin.find_first_not_of(" \t"));
    if (text.empty())
      return;
    lines_.insert(line);
    finding.help = texts::Write(text);
    finding.fix =
        Fix{finding.help, {{source_.line_span(line), std::string(blanks) + text}}, Safety::Unsafe};
    mended_.insert(&finding);
    texts_[line] = std::string(blanks) + text;
    open->help = texts::WriteOnLine(text, line);
    open->fix = finding.fix;
    if (word == "do") {
      open->help = texts::Write("repeat");
      open->fix = Fix{open->help,
                      {{source_.line_span(line_of(*open)), std::string(blanks) + "repeat"}},
                      Safety::Unsafe};
      texts_[line_of(*open)] = std::string(blanks) + "repeat";
      lines_.insert(line_of(*open));
      mended_.insert(open);
    }
  }

  /// Opens a block whose first line is `until`: the lines below it are indented further.
  void open_block(Diagnostic& finding) {
    const auto line = line_of(finding);
    const auto tokens = tokens_at(line);
    const auto next = below(line);
    if (!is_block_end(finding) || tokens.size() < 2 || !tokens[0].is("until") || next == 0 ||
        indent(next) <= indent(line))
      return;
    lines_.insert(line);
    const auto text = "while " + until(Tokens(tokens.begin() + 1, tokens.end()));
    finding.help = texts::Write(text);
    const auto begin = source_.line_start(line) + static_cast<std::uint32_t>(indent(line));
    finding.fix = Fix{finding.help, {{{begin, source_.line_span(line).end}, text}}, Safety::Unsafe};
    mended_.insert(&finding);
    texts_[line] = std::string(source_.line(line).substr(0, indent(line))) + text;
  }

  std::size_t indent(std::uint32_t line) const {
    const auto text = source_.line(line);
    return std::min(text.find_first_not_of(" \t"), text.size());
  }

  /// The end condition of a loop that runs while a condition holds.
  std::string until(const Tokens& condition) const {
    if (condition.size() > 1 && condition[0].is("not"))
      return repair::join(Tokens(condition.begin() + 1, condition.end()));
    return opposite(condition, dialect_.language).value_or("");
  }

  void offer(Diagnostic& finding) {
    if (is_consequence(finding))
      return;
    if (join_if(finding)) {
      mended_.insert(&finding);
      return;
    }
    if (join_values(finding)) {
      mended_.insert(&finding);
      return;
    }
    if (is_unknown(finding) && mend_definition(source_, dialect_, scenery_, before_, finding)) {
      mended_.insert(&finding);
      return;
    }
    auto at = line_of(finding);
    const bool here = is_about_writing(finding, source_, dialect_, at);
    auto line = read(at);
    auto found = here ? mend(line, finding) : std::vector<Accepted>();
    if (found.empty() && continues(at) && lines_.insert(at - 1).second) {
      line = read(--at);
      found = mend(line, finding);
      if (!found.empty())
        finding.span = source_.line_span(at);
    }
    if (!found.empty()) {
      write(finding, line, at, found);
      mended_.insert(&finding);
      if ((found.size() == 1 || dialect_.language == Language::Test) &&
          (found[0].fewer || found[0].open))
        texts_[at] = found[0].text;
    } else if (here && finding.fix && says_line(finding.help) && !mends(finding)) {
      finding.help = {}; // it would only replace one error by another
      finding.fix.reset();
    } else if (here && says_little(finding)) {
      // Prefer advice on the line as typed, then on the line as read.
      auto advice = advise(split(line.written, line.language()).tokens, line.around);
      if (advice.empty())
        advice = advise(line.tokens, line.around);
      if (!advice.empty())
        finding.help = std::move(advice);
    }
  }

  /// True if the fix of a finding alone reduces the number of errors.
  bool mends(Diagnostic finding) const {
    finding.fix->safety = Safety::Safe; // as if accepted
    return errors_in(dialect_.check(apply_fixes(source_.text(), {finding}).text)) <
           errors_in(before_);
  }

  /// Drops the proposal for a line that becomes correct once the others are repaired: it was judged
  /// before them. Keeps it for lists below `prints`.
  void take_back(const std::vector<Diagnostic*>& findings) {
    if (texts_.size() < 2)
      return;
    std::optional<std::size_t> errors; // of the repaired text
    for (auto* finding : findings) {
      if (!errors)
        errors = errors_in(dialect_.check(whole_text()));
      const auto mended = texts_.extract(line_of(*finding));
      if (mended.empty())
        continue;
      if (errors_in(dialect_.check(whole_text())) > *errors) {
        texts_.insert({mended.key(), mended.mapped()});
        continue;
      }
      *finding = before_[static_cast<std::size_t>(finding - findings_.data())];
      mended_.erase(finding);
    }
  }

  /// The start of a block may have been repaired after its contents: judges each line again from
  /// the top down, among the others.
  void offer_again(const std::vector<Diagnostic*>& findings) {
    if (texts_.empty() || errors_in(dialect_.check(whole_text())) == 0)
      return;
    for (auto finding = findings.rbegin(); finding != findings.rend(); ++finding) {
      const auto& first = before_[static_cast<std::size_t>(*finding - findings_.data())];
      const auto at = line_of(first);
      if (!is_about_writing(first, source_, dialect_, at) ||
          (mended_.contains(*finding) && !texts_.contains(at))) // together with other lines
        continue;
      auto line = read(at);
      auto again = first;
      const auto found = mend(line, again);
      if (found.size() != 1 || !(found[0].fewer || found[0].open) ||
          (texts_.contains(at) && texts_[at] == found[0].text))
        continue;
      **finding = again;
      write(**finding, line, at, found);
      mended_.insert(*finding);
      texts_[at] = found[0].text;
    }
  }

  /// Updates the end of an unclosed block whose first line is repaired.
  void close_mended() {
    for (auto& finding : findings_) {
      const auto mended = texts_.find(line_of(finding));
      if (!is_unclosed(finding) || mended == texts_.end())
        continue;
      const auto word = word_at(split(mended->second, dialect_.language).tokens, 0);
      const auto was = end_of(source_.text(finding.span));
      const auto& said = finding.help.fillers();
      const auto at = std::find(said.begin(), said.end(), was);
      if (at != said.end() && !word.empty())
        finding.help.refill(static_cast<std::size_t>(at - said.begin()), end_of(word));
    }
  }

  /// The end of a block, as shown in a finding.
  static Message end_of(std::string_view word) {
    return Message::as_is("end " + std::string(word));
  }

  /// The lines from `from` up to `to` (exclusive), repaired where possible, with their line
  /// endings.
  std::string lines(std::uint32_t from, std::uint32_t to) const {
    std::string text;
    for (auto n = from; n < to; ++n) {
      const auto mended = texts_.find(n);
      const auto end = source_.line_span(n).end;
      text += mended != texts_.end() ? std::string_view(mended->second) : source_.line(n);
      text += source_.text().substr(end, source_.line_start(n + 1) - end);
    }
    return text;
  }
  std::string whole_text() const { return lines(1, source_.line_count() + 1); }

  /// Reads and normalises a line.
  Line read(std::uint32_t at) const {
    auto line = look_at(source_, dialect_, scenery_, at);
    normalise(line);
    return line;
  }

  /// Finds the replacements for a line, the best first; stores all checked ones in the finding.
  std::vector<Accepted> mend(Line& line, Diagnostic& finding) {
    const auto at = source_.position(line.begin).line;
    const auto context = around(at);
    return mend(line, context, before(at, context), finding);
  }

  /// The same for a line of another text, with the findings about that text.
  std::vector<Accepted> mend(Line& line, const Context& context,
                             const std::vector<Diagnostic>& before, Diagnostic& finding) {
    line.misplaced = finding.rule->trouble == Trouble::MisplacedStatement;
    const auto budget = checks_left();
    Trial trial(line, finding, context, before, budget);
    auto all = repair::mend(trial);
    checks_ += budget - trial.left();
    finding.considered = std::move(trial.considered());
    return all;
  }

  Context around(std::uint32_t line) const {
    const auto end = source_.line_span(line).end;
    return {lines(1, line),
            std::string(source_.text().substr(end, source_.line_start(line + 1) - end)) +
                lines(line + 1, source_.line_count() + 1)};
  }

  std::vector<Diagnostic> findings_about(const std::string& text) const {
    return text == source_.text() ? before_ : dialect_.check(text);
  }
  std::vector<Diagnostic> before(std::uint32_t line, const Context& context) const {
    return texts_.empty()
               ? before_
               : findings_about(context.above + std::string(source_.line(line)) + context.below);
  }

  /// Drops errors that disappear once the proposed lines are in place: an `end` whose block begins
  /// in another language.
  void drop_consequences() {
    std::vector<Diagnostic> offered;
    for (const auto& finding : findings_)
      if (finding.fix && mended_.contains(&finding))
        offered.push_back(finding);
    if (offered.empty() || offered.size() == errors_in(findings_))
      return;
    for (auto& one : offered)
      one.fix->safety = Safety::Safe; // as if all were accepted
    const Source then({}, apply_fixes(source_.text(), offered).text);
    const auto after = dialect_.check(then.text());
    for (const auto& one : after)
      if (keeps_from_building(one))
        replace_end(then, one);
    if (std::any_of(after.begin(), after.end(), [&](const Diagnostic& one) {
          return keeps_from_building(one) &&
                 std::none_of(findings_.begin(), findings_.end(), [&](const auto& was) {
                   return was.rule == one.rule && was.message == one.message;
                 });
        }))
      return; // the proposals do not go far enough to tell
    std::set<std::uint32_t> lines;
    for (const auto* finding : mended_)
      lines.insert(line_of(*finding));
    std::set<const Diagnostic*> gone;
    for (const auto& finding : findings_)
      if (keeps_from_building(finding) &&
          (!finding.fix || is_block_end(finding) || is_unclosed(finding) ||
           (lines.contains(line_of(finding)) && is_piecemeal(*finding.fix))) &&
          !mended_.contains(&finding) &&
          std::none_of(after.begin(), after.end(), [&](const Diagnostic& one) {
            return keeps_from_building(one) &&
                   ((one.rule == finding.rule && one.message == finding.message) ||
                    then.line(then.position(one.span.begin).line) ==
                        source_.line(line_of(finding)));
          }))
        gone.insert(&finding);
    std::erase_if(findings_, [&](const Diagnostic& one) { return gone.contains(&one); });
  }

  /// Replaces the finding about a block end, such as a `next` without a loop, by the finding in the
  /// repaired program.
  void replace_end(const Source& then, const Diagnostic& told) {
    const auto n = then.position(told.span.begin).line;
    const auto line = then.line(n);
    const auto column = told.span.begin - then.line_start(n);
    for (auto& finding : findings_) {
      const auto at = line_of(finding);
      if (!is_block_end(finding) || mended_.contains(&finding) || source_.line(at) != line ||
          told.rule == finding.rule)
        continue;
      finding = told;
      finding.span.begin = source_.line_start(at) + column;
      finding.span.end = std::min(finding.span.begin + told.span.size(), source_.line_span(at).end);
      finding.fix.reset();
      finding.notes.clear();
    }
  }

  /// Joins lines for a message: "write `print "hi"`, then `delay 2s`"; without lines it says to
  /// remove the line.
  template <typename Shown>
  static Message in_turn(std::string_view lines, Shown shown) {
    std::vector<std::string> all;
    for (std::size_t at = 0; at < lines.size();) {
      const auto end = std::min(lines.find_first_of("\r\n", at), lines.size());
      all.emplace_back(shown(lines.substr(at, end - at)));
      at = std::min(lines.find_first_not_of("\r\n", end), lines.size());
    }
    switch (all.size()) {
    case 0: return texts::RemoveLine();
    case 1: return texts::Write(all[0]);
    case 2: return texts::WriteTwo(all[0], all[1]);
    case 3: return texts::WriteThree(all[0], all[1], all[2]);
    default: break;
    }
    auto help = texts::WriteFour(all[0], all[1], all[2], all[3]);
    for (std::size_t i = 4; i < all.size(); ++i)
      help = texts::Then(std::move(help), all[i]);
    return help;
  }

  static Message in_turn(const Line& line, std::string_view lines) {
    return in_turn(lines, [&](std::string_view one) { return shown(line, one); });
  }

  void write(Diagnostic& finding, const Line& line, std::uint32_t at,
             const std::vector<Accepted>& found) const {
    const auto text = shown(line, found[0].text);
    const bool one_line = found.size() > 1 &&
                          found[1].text.find_first_of("\r\n") == std::string::npos &&
                          found[0].text.find_first_of("\r\n") == std::string::npos;
    if (one_line && shown(line, found[1].text) != text) {
      finding.help = texts::WriteEither(text, shown(line, found[1].text));
      finding.fix.reset();
      return;
    }
    const auto lines = text.empty() ? texts::RemoveLine() : in_turn(line, found[0].text);
    finding.help =
        found[0].note == nullptr ? lines : texts::Because(lines, Message(*found[0].note, {}));
    if (const auto own = fixed(line, finding);
        is_safe(finding) && (!own || without_blanks(*own) == without_blanks(found[0].text)))
      return; // its own fix suffices
    const bool safe = found[0].sure && (found[0].fewer || is_safe(finding)) &&
                      says_the_same(line.written, found[0].text);
    const auto safety = safe ? Safety::Safe : Safety::Unsafe;
    if (text.empty()) {
      finding.fix = remove(at, safety);
      if (finding.fix && finding.fix->title.is(texts::EndHere))
        finding.help = texts::Write(finding.fix->edits[0].text);
      return;
    }
    finding.fix = Fix{lines, {difference(line.written, found[0].text, line.begin)}, safety};
  }

  /// Removes a line; jumps to it are redirected to the next line, or to an `end` in its place.
  std::optional<Fix> remove(std::uint32_t line, Safety safety) const {
    Fix fix{texts::RemoveLine(), {}, safety};
    const auto number =
        dialect_.language == Language::Basic ? scenery_.number(line) : std::string();
    const auto jumps = number.empty() ? std::vector<Span>() : scenery_.jumps_to(number);
    const auto next = jumps.empty() ? std::string() : scenery_.number_below(line);
    if (!jumps.empty() && next.empty()) {
      fix.title = texts::EndHere();
      fix.edits.push_back({source_.line_span(line), number + " end"});
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
  const Dialect& dialect_;
  std::vector<Diagnostic>& findings_;
  const std::vector<Diagnostic> before_;
  Scenery scenery_;
  std::vector<std::string> names_;             ///< defined by the program
  std::set<std::uint32_t> lines_;              ///< already examined
  std::set<const Diagnostic*> mended_;         ///< of `findings_`: those with a proposal from here
  std::map<std::uint32_t, std::string> texts_; ///< repaired text, by line
  int checks_ = 0;
};

} // namespace

void offer_lines(std::string_view text, const Dialect& dialect, std::vector<Diagnostic>& findings) {
  if (text.size() <= most_bytes && errors_in(findings) > 0)
    Offers(text, dialect, findings).make();
}

} // namespace orb::repair
