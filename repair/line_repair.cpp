#include "repair/line_repair.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/fill.h"
#include "repair/idioms.h"
#include "repair/inflections.h"
#include "repair/units.h"

#include <algorithm>
#include <fmt/format.h>
#include <span>
#include <utility>

namespace orb::repair {
namespace {

constexpr std::size_t most_states = 90;  // of one line, by habits
constexpr std::size_t few_states = 40;   // of one line, by habits that take several
constexpr int most_candidates = 1000;    // of one line, by search
constexpr int deepest = 6;               // habits in one line
constexpr int surely = 6;                // one letter of a word
constexpr int clearly = 4;               // by so much the best change is cheaper than the next
constexpr std::uint32_t usual_step = 10; // of line numbers

/// Whether a text can only be the name of a file.
bool names_a_file(std::string_view text) {
  return text.find(' ') == std::string_view::npos && text.find('.') != std::string_view::npos;
}

/// Errors that no fix mends by itself.
std::size_t lasting_errors(const std::vector<Diagnostic>& findings) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [](const Diagnostic& one) {
        return keeps_from_building(one) && !(one.fix && one.fix->safety == Safety::Safe);
      }));
}

} // namespace

bool has_word(const std::vector<std::string_view>& words, std::string_view word) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view one) { return equal_words(one, word); });
}

std::size_t errors_in(const std::vector<Diagnostic>& findings) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), keeps_from_building));
}

LineRepair::LineRepair(const Source& source, const Judge& judge, const Scenery& scenery,
                       std::uint32_t line, const Context& context,
                       const std::vector<Diagnostic>& before, int most_checks)
    : judge_(judge), line_(source.line(line)), begin_(source.line_start(line)), context_(context),
      lasting_(lasting_errors(before)), parts_(split(line_, judge.language)),
      around_(scenery.around(line, parts_)), sub_(scenery.sub_of(parts_.tokens)),
      like_(parts_.tokens.empty() ? "" : scenery.sub_like(parts_.tokens[0].text)),
      meant_(scenery.sub_meant(values_between(parts_.tokens, 1))), is_target_(false),
      most_checks_(most_checks) {
  errors_ = errors_of(before, context.above + std::string(line_) + context.below);
  around_.elsewhere = scenery.words_without(parts_.tokens);
  if (judge.language != Language::Basic)
    names_ = around_.elsewhere;
  if (judge.language == Language::Basic) {
    is_target_ = !scenery.jumps_to(scenery.number(line)).empty();
    number_below_ = scenery.number_below(line);
    around_.names = scenery.set_without(parts_.tokens);
    letters_ = scenery.letters_without(parts_.tokens);
  }
  for (const auto name : names_)
    if (!has_word(judge.words, name))
      around_.names.push_back(name);
  canonical();
  if (judge.language == Language::Basic)
    resolve_labels(scenery);
  if (judge.language == Language::Structured) {
    drop_pronoun(scenery);
    index_arrays(scenery);
  }
}

std::vector<Accepted> LineRepair::find(const Diagnostic& finding) {
  const auto& tokens = parts_.tokens;
  if (tokens.size() > most_tokens)
    return {};
  misplaced_ = finding.rule->trouble == Trouble::MisplacedStatement;
  if (judge_.language == Language::Macro && !tokens.empty() && tokens[0].is_number())
    name_command();
  if (best_)
    return offers();
  if (tokens.size() > 1 && tokens[0].is_number() && tokens[1].is_number())
    return {}; // of what?
  if (judge_.language == Language::Macro && tokens.size() == 1 && !around_.closer.empty() &&
      holds("loop end next repeat", tokens[0].text))
    attempt(around_.closer, {}, false);
  if (judge_.language == Language::Test && parts_.head.empty() && tokens.size() == 1 &&
      tokens[0].is_text())
    attempt("test " + join(tokens), {}, false);
  if (judge_.language == Language::Test && parts_.head.empty() && tokens.size() == 2 &&
      tokens[1].is_text() && is_foreign(tokens[0].text) && !names_a_file(tokens[1].text) &&
      !is_called("print", tokens[0].text))
    attempt("test " + join({tokens[1]}), {}, false); // `comprobar "goes home"`
  if (judge_.language == Language::Structured)
    own_words();
  if (!tokens.empty())
    one_by_one();
  if (best_)
    return offers();
  const auto start = join(parts_.tokens);
  // What another language needs and this one does not is not all that the line says there.
  const auto own = fixed(finding);
  const auto* edit = own ? &finding.fix->edits.front() : nullptr;
  const bool leaves_out = edit != nullptr && edit->text.empty() && edit->span.size() > 0 &&
                          is_letter(line_[edit->span.begin - begin_]) &&
                          own->find_first_not_of(" \t;", parts_.head.size()) != std::string::npos;
  // The same words in another order say what was meant, whatever else is told of the line.
  if (rephrase(parts_.tokens) || (best_ && begins_alike(best_->text)))
    return offers();
  for (const auto& text : with_one_quote())
    if (!best_)
      attempt(text, {}, true);
    else if (!other_)
      other_ = attempt_line(whole(text), {}, false, false);
  if (best_)
    return offers();
  if (const auto closed = with_bracket(); !closed.empty())
    attempt(closed, {}, true);
  if (tokens.size() == 2 && tokens[1].text == around_.loop && is_foreign(tokens[0].text) &&
      judge_.language == Language::Structured && !is_misspelt(tokens[0].text))
    attempt("next " + around_.loop, {}, false); // `avanti i`
  own_call(start);
  if (!best_ && judge_.language == Language::Structured)
    own_sub();
  const bool bare_return = tokens.size() == 1 && tokens[0].is("return");
  const bool calls = (!sub_.empty() && parts_.tokens[0].text == sub_) || bare_return;
  if (calls && !best_ && finding.rule->trouble == Trouble::ArgumentCount)
    return {}; // which value is missing is said, whatever others call so
  if (!best_ && !calls && (!own || leaves_out || finding.fix->safety != Safety::Safe))
    several_lines(start);
  if (!best_ && !leaves_out && own && !is_foreign(*own) && repair::is_unknown(finding))
    by_fix(finding); // it knows the names and the blocks
  const bool remark = parts_.tokens.empty() && !parts_.comment.empty();
  if (remark) // `#end while`
    attempt(std::string(trim(std::string_view(parts_.comment).substr(1))), {}, false);
  const bool filled = std::any_of(tokens.begin(), tokens.end(), [](const Token& token) {
    return token.is_text() && token.text.find("${") != std::string::npos; // `${N} tries`
  });
  if (!best_ && !filled && whole(start) != line_)
    attempt(start, {}, !guessed_);

  const bool known = is_known_word(parts_.tokens.empty() ? "" : parts_.tokens[0].text, Where::Line);
  if (!best_ && !known) {
    by_gist();
    if (!best_)
      by_changes(surely);
  }
  if (!best_ || !best_->settles())
    habits(start, {deepest, judge_.language == Language::Test ? few_states : most_states});
  if (!best_ || !best_->quiet)
    by_fix(finding);
  if (!best_)
    by_words_left_out();
  if (!best_ && known)
    by_gist();
  if (!best_ && judge_.language == Language::Basic)
    by_initials();
  if (!best_)
    by_changes(1000);
  if (!best_)
    among_unknown();
  if (!best_)
    by_leaving_out();
  if (best_ && !other_)
    other_ = in_milliseconds();
  return offers();
}

/// The best line and, where it is not clear which was meant, the other one.
std::vector<Accepted> LineRepair::offers() const {
  std::vector<Accepted> all;
  if (best_)
    all.push_back(*best_);
  if (other_)
    all.push_back(*other_);
  return all;
}

/// The line as it would be if a time that was taken for seconds was one in milliseconds: from some
/// number on, both are likely.
std::optional<Accepted> LineRepair::in_milliseconds() {
  constexpr int few = 5;
  constexpr int half_second = 30; // sixtieths
  constexpr int most_ticks = 600;
  const auto& tokens = parts_.tokens;
  constexpr std::string_view in_seconds = " * 1000";
  if (best_->text.ends_with(in_seconds) && !has_token(tokens, "1000")) // `time.sleep(pause)`
    return attempt_line(best_->text.substr(0, best_->text.size() - in_seconds.size()), best_->note,
                        false, false);
  if (tokens.size() < 2)
    return std::nullopt;
  const bool calls = tokens.size() == 4 && tokens[1].is("(") && tokens[3].is(")"); // `pause(20)`
  const auto& value = tokens[calls ? 2 : tokens.size() - 1];
  if (!(calls || tokens.size() == 2) || !value.is_number() ||
      parse_number<int>(value.text).value_or(0) < few ||
      best_->text.find('\n') != std::string::npos)
    return std::nullopt;
  if (const auto ticks = parse_number<int>(value.text).value_or(0); // sixtieths, in Logo
      tokens[0].is("wait") && ticks % half_second == 0 && ticks <= most_ticks &&
      judge_.language != Language::Macro && best_->text.ends_with(" " + value.text)) {
    const auto before = best_->text.substr(0, best_->text.size() - value.text.size());
    const auto ms = ticks / half_second * 500;
    return attempt_line(
        before + (judge_.language == Language::Basic ? std::to_string(ms) : time_text(ms)),
        best_->note, false, false);
  }
  const auto number = " " + value.text;
  const std::string_view line = best_->text;
  if (line.ends_with(number + "000"))
    return attempt_line(best_->text.substr(0, line.size() - 3), best_->note, false, false);
  if (line.ends_with(number + "s"))
    return attempt_line(best_->text.substr(0, line.size() - 1) + "ms", best_->note, false, false);
  return std::nullopt;
}

Message LineRepair::advice() const {
  return advise(parts_.tokens, around_);
}

std::string LineRepair::shown(std::string_view text) const {
  auto parts = split(text, judge_.language);
  const auto tail = text.substr(text.size() - std::min(text.size(), parts.comment.size()));
  if (!parts.comment.empty() && !parts.tokens.empty() && line_.ends_with(tail))
    parts.comment.clear();
  return std::string(trim(join(parts)));
}

std::string LineRepair::whole(std::string_view statement) const {
  if (statement.empty() && parts_.comment.empty())
    return {};
  auto text = parts_.head;
  text += statement;
  if (!parts_.comment.empty())
    text += (statement.empty() ? "" : " ") + parts_.comment;
  return text;
}

/// Statements, each in the words of the language; nothing where one has none.
std::string LineRepair::spelled(const std::string& statements, int depth) const {
  const auto end = statements.find('\n');
  if (end != std::string::npos) {
    const auto first = spelled(statements.substr(0, end), depth);
    const auto rest = first.empty() ? first : spelled(statements.substr(end + 1), depth);
    return rest.empty() ? rest : first + '\n' + rest;
  }
  if (judge_.parses(parts_.head + statements))
    return statements;
  std::string found;
  std::unordered_set<std::string> seen;
  if (depth < 2)
    explore(statements, around_, {3, few_states}, seen, rewrites_, [&](const Rewritten& one) {
      if (one.text.find('\n') != std::string::npos)
        found = spelled(one.text, depth + 1);
      else if (judge_.parses(parts_.head + one.text))
        found = one.text;
      return !found.empty();
    });
  return found;
}

/// Statements, each on a line; nothing where there are no numbers for them.
std::string LineRepair::several(std::string_view statements) const {
  if (statements.empty())
    return {};
  const auto lines =
      static_cast<std::uint32_t>(std::count(statements.begin(), statements.end(), '\n') + 1);
  const auto number = parse_number<std::uint32_t>(around_.line_number).value_or(0);
  const auto below = parse_number<std::uint32_t>(number_below_).value_or(greatest_line_number);
  const bool numbered = judge_.language == Language::Basic;
  const auto step = below > number ? std::min((below - number) / lines, usual_step) : 0;
  if (numbered && step == 0)
    return {};
  const auto end = statements.find('\n');
  auto text = whole(statements.substr(0, end));
  for (std::uint32_t n = 1; n < lines; ++n) {
    statements.remove_prefix(statements.find('\n') + 1);
    text += line_end_of(context_.below);
    text += numbered ? std::to_string(number + n * step) + " " : parts_.head;
    text += statements.substr(0, statements.find('\n'));
  }
  return text;
}

/// The same declaration by its other word, where the program may need that: what returns nothing is
/// a sub, what gives a value a function, what sizes an array a constant. Empty where there is none.
std::string LineRepair::declared_otherwise(const std::string& statement) const {
  constexpr std::string_view function = "function ";
  constexpr std::string_view sub = "sub ";
  if (statement.starts_with(function))
    return fmt::format("{}{}", sub, statement.substr(function.size()));
  if (statement.starts_with(sub))
    return fmt::format("{}{}", function, statement.substr(sub.size()));
  const auto equals = statement.find(" = ");
  const bool sets = judge_.language == Language::Structured && parts_.head.empty() &&
                    equals != std::string::npos && statement.find(' ') == equals;
  return sets ? "const " + statement : std::string();
}

/// Tries a line in its place; true when it cannot be better.
bool LineRepair::attempt(const std::string& statement, const orb::Text* note, bool sure) {
  if (!keeps_meaning(statement))
    return false;
  const bool one = statement.find('\n') == std::string::npos;
  const auto text = one ? whole(statement) : several(spelled(statement, 0));
  if (!one && text.empty())
    return false;
  const auto accepted = attempt_line(text, note, sure);
  const bool begins = statement.starts_with("sub ") || statement.starts_with("function ");
  if (one && (accepted ? accepted->errors > 0 : begins))
    if (const auto other = declared_otherwise(statement); !other.empty())
      attempt_line(whole(other), note, sure);
  return accepted && best_ && best_->settles();
}

bool LineRepair::parses(std::string_view lines) const {
  while (!lines.empty()) {
    const auto end = lines.find_first_of("\r\n");
    if (!judge_.parses(lines.substr(0, end)))
      return false;
    lines.remove_prefix(std::min(lines.find_first_not_of("\r\n", end), lines.size()));
  }
  return true;
}

/// Errors but unknown names that this line does not have: while it did not parse, nobody asked for
/// them.
std::size_t LineRepair::errors_of(const std::vector<Diagnostic>& findings,
                                  std::string_view text) const {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [&](const Diagnostic& one) {
        const auto has = [&](std::string_view word) {
          return std::any_of(parts_.tokens.begin(), parts_.tokens.end(),
                             [&](const Token& token) { return token.text == word; });
        };
        return keeps_from_building(one) && (one.rule->trouble != Trouble::UnknownName ||
                                            has(text.substr(one.span.begin, one.span.size())));
      }));
}

std::optional<Accepted> LineRepair::attempt_line(const std::string& text, const orb::Text* note,
                                                 bool sure, bool keep) {
  const bool goes_on = text.ends_with(',') && !trim(line_).ends_with(','); // nothing follows
  if (text == line_ || goes_on || checks_ >= most_checks_ || !keeps_texts(text) ||
      !keeps_leaving(text) || !keeps_functions(text) || joins_numbers(text) || !parses(text))
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
    open = open || is_unclosed(one) || is_block_end(one);
    if (one.span.begin < begin || one.span.begin > begin + text.size())
      continue;
    if (keeps_from_building(one) && !is_unclosed(one))
      return std::nullopt;
    quiet = quiet && one.severity == Severity::Info;
  }
  const auto errors = errors_of(found, changed);
  if (errors > errors_ || (!keep && errors == errors_))
    return std::nullopt;
  Accepted accepted{text, note,  errors < errors_ || lasting_errors(found) < lasting_, quiet, sure,
                    open, errors};
  if (keep &&
      (!best_ || errors < best_->errors || (errors == best_->errors && quiet && !best_->quiet)))
    best_ = accepted;
  return accepted;
}

/// Whether lines begin with the word that the line begins with.
bool LineRepair::begins_alike(std::string_view lines) const {
  const auto& word = parts_.tokens.front().text;
  const auto begin = lines.substr(std::min(parts_.head.size(), lines.size()));
  return begin.starts_with(word) && begin.substr(word.size()).starts_with(' ');
}

/// Whether a line has a word that means nothing to the language and that no other line has.
bool LineRepair::is_foreign(std::string_view line) const {
  const auto tokens = split(line, judge_.language).tokens;
  return std::any_of(tokens.begin(), tokens.end(), [&](const Token& token) {
    return token.is_word() && token.text.size() > 1 && !has_word(judge_.words, token.text) &&
           !has_word(around_.elsewhere, token.text);
  });
}

/// Whether a token is a word that neither the language nor the program knows, and that turns
/// nothing into its opposite.
bool LineRepair::is_unknown(const Token& token) const {
  const bool article = judge_.language != Language::Basic && token.is("a") &&
                       !has_word(around_.elsewhere, token.text);
  return token.is_word() && (article || (token.text.size() > 1 && is_foreign(token.text))) &&
         !is_called("never", token.text) && !mean_the_same("not", token.text);
}

/// Tries what the language makes of the line's values; true when that cannot be better.
bool LineRepair::rephrase(const Tokens& line) {
  if (!judge_.rephrase || line.empty())
    return false;
  for (const auto& one : judge_.rephrase(line)) {
    if (!attempt(one.text, {}, one.sure))
      continue;
    if (!one.other.empty())
      other_ = attempt_line(whole(one.other), {}, false, false);
    return true;
  }
  return false;
}

/// `0 200 255`: values whose command was forgotten.
void LineRepair::name_command() {
  const auto& tokens = parts_.tokens;
  if (std::any_of(tokens.begin(), tokens.end(),
                  [](const Token& token) { return !token.is_number() && !token.is(","); }))
    return;
  const auto values = tokens.size() - static_cast<std::size_t>(count_of(","));
  const auto line = join(parts_.tokens);
  if (values == 4)
    attempt("fade " + line, {}, false);
  if (values != 3)
    return;
  attempt("rgb " + line, {}, false);
  if (best_)
    other_ = attempt_line(whole("roll " + line), {}, false, false);
}

/// Applies habits until the line is one.
void LineRepair::habits(const std::string& statement, Bounds bounds) {
  explore(statement, around_, bounds, seen_, rewrites_, [&](const Rewritten& one) {
    return attempt(one.text, one.note, one.sure) ||
           (judge_.rephrase && rephrase(tokens_of(one.text, judge_.language)));
  });
}

/// `drive 0, 1s`, `call drive(0, 1s)` and `wait for shake` where the program has a sub of that
/// name, whatever else people call so.
void LineRepair::own_call(const std::string& statement) {
  if (sub_.empty() || parts_.tokens.size() < 2)
    return;
  const bool spread = parts_.tokens[0].text != sub_ && parts_.tokens[1].text != sub_;
  const bool adds_words =
      parts_.tokens[0].text == sub_ &&
      std::all_of(parts_.tokens.begin() + 1, parts_.tokens.end(),
                  [&](const Token& token) { return is_unknown(token) || token.is_number(); });
  if ((spread || adds_words) && attempt(sub_, {}, true))
    return;
  std::unordered_set<std::string> seen;
  explore(statement, around_, {1, few_states}, seen, rewrites_, [&](const Rewritten& one) {
    return one.text.starts_with(sub_ + "(") && attempt(one.text, one.note, one.sure);
  });
}

/// `colore(i)` where there is a `colour`; `trazo(90)` where nobody calls the only `stroke` yet, or
/// only `stroke` takes one value.
void LineRepair::own_sub() {
  const auto& tokens = parts_.tokens;
  const bool calls =
      tokens.size() == 1 || (tokens.size() > 2 && tokens[1].is("(") && tokens.back().is(")"));
  if ((meant_.empty() && like_.empty()) || !calls || !tokens[0].is_word() ||
      !is_foreign(tokens[0].text))
    return;
  const bool known = is_known_word(tokens[0].text, Where::Line) ||
                     !known_form_of(tokens[0].text, judge_.language).empty();
  if (like_.empty() && known)
    return;
  auto called = tokens;
  called[0].text = like_.empty() ? meant_ : like_;
  attempt(join(called), {}, false);
}

/// Words that mean what a name of the program means: `Richtung` where there is a `direction`.
void LineRepair::own_words() {
  auto tokens = parts_.tokens;
  bool any = false;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    auto& token = tokens[i];
    const bool acts = i == 0 && !(tokens.size() > 1 && tokens[1].is("="));
    const bool unit = i > 0 && tokens[i - 1].is_number();
    if (acts || unit || !token.is_word() || holds("true false on off", token.text) ||
        milliseconds_of(token.text) > 0 || meanings_of(token.text).empty() ||
        !is_foreign(token.text) || is_known_word(token.text, Where::Line))
      continue;
    const auto own = std::find_if(names_.begin(), names_.end(), [&](std::string_view name) {
      return milliseconds_of(name) == 0 && !has_word(judge_.words, name) &&
             mean_the_same(name, token.text);
    });
    const bool said = own != names_.end() && i + 1 < tokens.size() && tokens[i + 1].text == *own;
    if (own == names_.end() || said) // `direction course` names it already
      continue;
    token.text = *own;
    any = true;
  }
  if (any && !attempt(join(tokens), {}, false) && !tokens[0].is("print")) // words are printed
    parts_.tokens = std::move(tokens); // something else is wrong, too
}

/// Habits that are several lines here: they say more than any one line.
void LineRepair::several_lines(const std::string& statement) {
  std::unordered_set<std::string> seen;
  explore(statement, around_, {3, few_states}, seen, rewrites_, [&](const Rewritten& one) {
    return one.text.find('\n') != std::string::npos && attempt(one.text, one.note, one.sure);
  });
}

std::optional<std::string> LineRepair::fixed(const Diagnostic& finding) const {
  if (!finding.fix || finding.fix->edits.empty())
    return std::nullopt;
  std::string text(line_);
  for (auto edit = finding.fix->edits.rbegin(); edit != finding.fix->edits.rend(); ++edit) {
    if (edit->span.begin < begin_ || edit->span.end > begin_ + line_.size() ||
        edit->text.find('\n') != std::string::npos)
      return std::nullopt;
    text.replace(edit->span.begin - begin_, edit->span.size(), edit->text);
  }
  return text;
}

/// What the language itself offers.
void LineRepair::by_fix(const Diagnostic& finding) {
  const auto text = fixed(finding);
  if (!text)
    return;
  const auto accepted = attempt_line(*text, {}, finding.fix->safety == Safety::Safe);
  if (accepted && accepted->errors > 0)
    if (const auto other = declared_otherwise(text->substr(parts_.head.size())); !other.empty())
      attempt_line(whole(other), {}, false);
}

/// The nearest line; two where it is not clear which.
void LineRepair::by_changes(int most) {
  if (judge_.language == Language::Basic && holds_name(parts_.tokens, around_))
    return; // which is to become a letter: no change of this line alone mends that
  if (near_.empty())
    near_ = changes(parts_.tokens, judge_.language, judge_.words, names_);
  const auto end = std::find_if(near_.begin(), near_.end(),
                                [&](const Candidate& one) { return one.cost > most; });
  const auto first =
      std::span<const Candidate>(near_).first(static_cast<std::size_t>(end - near_.begin()));
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
    habits(one.text, {3, seen_.size() + 8});
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

} // namespace orb::repair
