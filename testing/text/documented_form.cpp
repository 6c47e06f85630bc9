#include "testing/text/documented_form.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/idioms.h"
#include "testing/text/plain_line.h"
#include "testing/text/vocabulary.h"
#include "vm/stimulus.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace orb::testing {
namespace {

using repair::Rephrased;
using repair::Token;
using repair::Tokens;

/// The condition of an expectation, as test files write it.
struct Condition {
  const ExpectationInfo* row = nullptr; ///< the first, if there are several
  std::string text;
  std::string lasts; ///< the time in `for 2s`
  std::optional<SaidWhen> when;
  std::vector<std::string> more; ///< what has to go on separate lines
  bool sure = true;
};

/// When, in the words of test files; a second reading if two are likely.
struct Timing {
  std::string text;
  std::string other = {};
  bool sure = true;
};

template <class Fits>
bool any(const Pieces& pieces, Fits fits) {
  return std::any_of(pieces.begin(), pieces.end(), fits);
}

bool is_not(const Piece& piece) {
  return piece.is(Piece::Word) && piece.means_any("not never");
}

bool is_whole_text(const Piece& piece) {
  return !piece.inner.empty() && piece.text[0] == '"';
}

bool expects(const Piece& piece) {
  return std::any_of(expectations.begin(), expectations.end(),
                     [&](const ExpectationInfo& row) { return piece.means(row.word); });
}

/// True if a word alone can name a zone: it is not close to a word of the test language.
bool names_zone(const Pieces& pieces) {
  std::vector<std::string_view> words;
  for (const auto& row : expectations)
    words.push_back(row.word);
  const auto name = std::find_if(pieces.begin(), pieces.end(), [](const Piece& piece) {
    return piece.is(Piece::Word) && piece.meanings.empty() && piece.colour.empty();
  });
  return name != pieces.end() && name->text.size() > 1 && !closest(name->text, words) &&
         !any(pieces, [](const Piece& one) { return !one.sign.empty(); });
}

class Form {
public:
  explicit Form(const SurroundingText& elsewhere) : elsewhere_(elsewhere) {}

  std::optional<Rephrased> expectation(Pieces all) {
    asks_ = never_ = std::erase_if(all, is_not) > 0;
    for (auto& piece : all) // `not.toContain("thrown")`
      if (never_ && is_whole_text(piece) &&
          any(all, [](const Piece& one) { return one.means("~"); }))
        piece.text.insert(0, "~");
    while (!all.empty() && (all[0].is(Piece::Sign) || all[0].means("expect") ||
                            holds("and then", lower(all[0].text)) ||
                            (all[0].says_nothing() && all.size() > 1 && all[1].means("expect")))) {
      asks_ = asks_ || all[0].means("expect");
      all.erase(all.begin());
    }
    if (std::erase_if(all, [](const Piece& one) { return equal_words(one.text, "false"); }) > 0)
      never_ = !never_;
    if (auto lines = never_ ? std::nullopt : printed_lines(all))
      return lines;
    const auto condition = joined(all, nullptr);
    if (!condition)
      return std::nullopt;
    constexpr std::string_view reach = "reach ";
    const bool reaches = condition->text.starts_with(reach) && !never_ && condition->more.empty() &&
                         condition->text.find(' ', reach.size()) == std::string::npos;
    const auto timing = timing_of(condition->row->kind, condition->when);
    const auto line = [&](const std::string& when) {
      auto texts = condition->more;
      texts.insert(texts.begin(), condition->text);
      std::string lines;
      for (const auto& text : texts)
        lines += fmt::format("{}{}{}{}{}{}{}", lines.empty() ? "" : "\n",
                             never_    ? "never "
                             : reaches ? ""
                                       : "expect ",
                             text, condition->lasts.empty() ? "" : " for ", condition->lasts,
                             when.empty() ? "" : " ", when);
      return lines;
    };
    return Rephrased{line(timing.text), condition->sure && timing.sure,
                     timing.other.empty() ? std::string() : line(timing.other)};
  }

  std::optional<Rephrased> stimulus(const Pieces& line) const {
    for (std::size_t i = 0; i < line.size(); ++i)
      for (const auto& row : vm::stimulus_words)
        if (line[i].means(row.word))
          if (auto one = row.word == "wall" ? walls(line, i, row) : happens(line, i, row))
            return one;
    return std::nullopt;
  }

  /// Reads a line of the head, or `test`.
  std::optional<Rephrased> setting(const Pieces& line) const {
    std::size_t at = 0;
    while (at + 1 < line.size() && line[at].says_nothing() && !line[at].means("for"))
      ++at;
    for (const auto& row : line_words) {
      Filling filling(line, elsewhere_);
      if (row.slots[0].kind == slot::Kind::Rest || !line[at].means(row.word))
        continue;
      const auto values = filling.fill(row.slots, at);
      if (values && filling.is_empty(row.word))
        return Rephrased{std::string(row.word) + *values, filling.is_sure()};
    }
    return std::nullopt;
  }

private:
  /// Reads pieces without joining words. `like` is the expectation before them.
  std::optional<Condition> single(const Pieces& pieces, const ExpectationInfo* like) {
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (const auto meaning : pieces[i].meanings) {
        const bool reach = meaning == info(LineWord::Reach).word;
        for (const auto& row : expectations)
          if (row.word == meaning || (reach && &row == &info(Word::Inside)))
            if (auto condition = filled(pieces, row, i, meaning))
              return condition;
      }
    std::vector<const ExpectationInfo*> implied{&info(Word::Variable), &info(Word::Color),
                                                &info(Word::Beyond), &info(Word::Near)};
    // A text alone is a printed line.
    if (asks_ || any(pieces, [](const Piece& one) { return one.text.starts_with('~'); }))
      implied.push_back(&info(Word::Print));
    if (depth_ == 0 && elsewhere_.has_course && names_zone(pieces))
      implied.push_back(&info(Word::Inside));
    if (like != nullptr)
      implied.insert(implied.begin(), like);
    for (const auto* row : implied)
      if (auto condition = filled(pieces, *row, SIZE_MAX, row->word))
        return condition;
    return std::nullopt;
  }

  std::optional<Condition> filled(const Pieces& pieces, const ExpectationInfo& row,
                                  std::size_t subject, std::string_view word) {
    if (--budget_ < 0)
      return std::nullopt;
    Filling filling(pieces, elsewhere_);
    const bool variable = &row == &info(Word::Variable);
    const auto values = filling.fill(row.slots, subject);
    if (!values || (variable && !pieces[0].is(Piece::Word)))
      return std::nullopt;
    Condition condition;
    condition.row = &row;
    condition.text = variable ? values->substr(1) : std::string(word) + *values;
    if (&row == &info(Word::Error))
      condition.text += filling.take_name();
    auto times = row.kind == Kind::Event ? filling.take_times() : std::string();
    if (!filling.take_when(condition.when, condition.lasts))
      return std::nullopt;
    if (row.kind == Kind::Event && times.empty() && depth_ == 0 && &row != &info(Word::Error))
      times = filling.take_count();
    condition.text += times;
    if (variable)
      condition.when = SaidWhen{"at", "end"};
    condition.sure = filling.is_sure() && (subject != SIZE_MAX || &row != &info(Word::Inside));
    return filling.is_empty(word) ? std::optional(condition) : std::nullopt;
  }

  bool is_joint(const Pieces& pieces, std::size_t at) const {
    const auto& piece = pieces[at];
    const auto& next = pieces[at + 1];
    if (piece.is(Piece::Sign))
      return piece.text == "," && (!next.colour.empty() || next.is(Piece::Text) || expects(next));
    return piece.means_any("and before then until") || (piece.means("after") && !next.is_time()) ||
           (never_ && equal_words(piece.text, "or") && expects(next));
  }

  /// Reads one or several expectations: at the same time, or one before the other.
  std::optional<Condition> joined(const Pieces& pieces, const ExpectationInfo* like) {
    if (auto one = single(pieces, like))
      return one;
    for (std::size_t at = 1; at + 1 < pieces.size(); ++at)
      if (is_joint(pieces, at))
        if (auto condition = join(pieces, at, at + 1, pieces[at], like))
          return condition;
    static const Piece both{Piece::Word, "and", {"and"}};
    for (std::size_t at = 2; at < pieces.size(); ++at) // `inside garage color green`
      if (expects(pieces[at]) && is_of_tests(pieces[at].text))
        if (auto condition = join(pieces, at, at, both, like))
          return condition;
    return std::nullopt;
  }

  std::optional<Condition> join(const Pieces& pieces, std::size_t end, std::size_t begin,
                                const Piece& joint, const ExpectationInfo* like) {
    Pieces before(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(end));
    Pieces behind(pieces.begin() + static_cast<std::ptrdiff_t>(begin), pieces.end());
    const bool after = joint.means("after");
    std::string lag; // `1s after`
    if (after && before.back().is_time() && before.size() > 1) {
      lag = time_of(before.back().most);
      before.pop_back();
    }
    bool then = joint.means("then");
    for (; !behind.empty() && behind[0].means_any("then and expect"); behind.erase(behind.begin()))
      then = then || behind[0].means("then");
    ++depth_;
    auto condition = single(before, like);
    const auto right = condition && !behind.empty() ? joined(behind, condition->row) : std::nullopt;
    --depth_;
    if (!right || (condition->when && right->when) ||
        (!condition->lasts.empty() && !right->lasts.empty()) || (never_ && !lag.empty()))
      return std::nullopt;
    const bool is_and = !then && (joint.is(Piece::Sign) || joint.means("and"));
    const auto& when = condition->when ? condition->when : right->when;
    condition->sure = condition->sure && right->sure && !then;
    condition->lasts += right->lasts;
    if (!is_and && !after && when)
      return std::nullopt; // a time cannot be combined with `before`
    if (!lag.empty())
      condition->text += fmt::format(" {} after {} by {}", lag, right->text,
                                     right->when ? right->when->time : slot::lag_by.usual);
    else if (equal_words(joint.text, "or") || (is_and && right->row->kind == Kind::Event))
      condition->more.push_back(right->text);
    else
      condition->text += fmt::format(" {} {}",
                                     is_and  ? "and"
                                     : after ? "after"
                                             : "before",
                                     right->text);
    condition->more.insert(condition->more.end(), right->more.begin(), right->more.end());
    condition->when = lag.empty() ? when : std::nullopt;
    return condition;
  }

  Timing timing_of(Kind kind, const std::optional<SaidWhen>& when) const {
    const auto bound = fmt::format("{}s", (elsewhere_.bound + 999ms) / Duration{1s});
    if (kind == Kind::End && elsewhere_.has_bound && (!when || when->time == "end"))
      return {"within " + bound, {}, false};
    if (!when)
      return {};
    const auto& [word, time] = *when;
    const bool at_end = time == "end";
    const bool is_state = kind == Kind::State || kind == Kind::Stay;
    const auto plain = fmt::format("{} {}", word, time);
    const auto within = "within " + time;
    const auto so_long = "during 0s.." + time;
    if (kind == Kind::Output && at_end)
      return {};
    if (kind == Kind::Final || kind == Kind::Output || (at_end && kind == Kind::End))
      return {plain};
    if (kind == Kind::End)
      return {"within " +
                  time.substr(time.find("..") == std::string::npos ? 0 : time.find("..") + 2),
              {},
              word != "after"};
    if (word.empty()) // it does not say which of `at` and `within`
      return {never_     ? so_long
              : is_state ? "at " + time
                         : within,
              is_state && !never_ ? within : std::string(), false};
    if (word == "until")
      return is_state && !never_ ? Timing{so_long, within, false}
                                 : Timing{is_state ? so_long : within};
    if (word == "after")
      return {is_state && !never_ ? "at " + time : fmt::format("during {}..{}", time, bound),
              {},
              false};
    if (never_ && !at_end && (word == "within" || (word == "at" && !is_state)))
      return {so_long};
    if (is_state || word != "at")
      return {plain};
    return {at_end ? std::string() : within};
  }

  /// Several texts are printed lines, one below the other. A single text is the first of them if
  /// others follow below.
  std::optional<Rephrased> printed_lines(const Pieces& pieces) const {
    std::string all;
    std::size_t count = 0;
    std::string_view says;
    for (const auto& piece : pieces)
      if (is_whole_text(piece) && !says.empty() && ++count > 0)
        all += "\n" + piece.text;
      else if (piece.means_any("print prints"))
        says = piece.means("prints") || says == "prints" ? "prints" : "print";
      else if (!piece.is(Piece::Sign) && !piece.says_nothing() && !piece.means("="))
        return std::nullopt;
    const bool lists = elsewhere_.has_texts && (count == 0 || says == "prints");
    return !says.empty() && (count > 1 || lists)
               ? std::optional(Rephrased{"expect prints" + all, count > 0})
               : std::nullopt;
  }

  std::optional<Rephrased> walls(const Pieces& line, std::size_t subject,
                                 const vm::StimulusInfo& row) const {
    Filling filling(line, elsewhere_);
    std::string all;
    while (const auto values = filling.fill(row.slots, subject))
      all += fmt::format("{}{}{}", all.empty() ? "" : "\n", row.word, *values);
    return all.empty() || !filling.is_empty(row.word) ? std::nullopt
                                                      : std::optional(Rephrased{all, true});
  }

  std::optional<Rephrased> happens(const Pieces& line, std::size_t subject,
                                   const vm::StimulusInfo& row) const;

  const SurroundingText& elsewhere_;
  bool asks_ = false; ///< contains `expect`, or a word for it
  bool never_ = false;
  int depth_ = 0;    ///< nesting of joined expectations
  int budget_ = 300; ///< attempts left for this line
};

/// Returns the slot that people call by this name; nothing if there is none.
std::optional<std::size_t> slot_called(const Slots& slots, const Piece& piece) {
  for (std::size_t i = 0; i < slots.size() && slots.size() > 1; ++i)
    if (const auto name = slots[i].called->english;
        equal_words(name, piece.text) || repair::is_called(name, piece.text))
      return i;
  return std::nullopt;
}

/// `at TIME WORD VALUES`: names, units and directions decide which value goes where.
std::optional<Rephrased> Form::happens(const Pieces& line, std::size_t subject,
                                       const vm::StimulusInfo& row) const {
  const auto& slots = row.slots;
  Filling filling(line, elsewhere_);
  filling.use(subject);
  const auto head = filling.take_moment(slots) + std::string(row.word);
  const bool counts =
      !slots.empty() && (slots[0].kind == slot::Kind::Number || slots[0].kind == slot::Kind::Whole);
  if (!counts) {
    const auto values = filling.fill(slots, subject);
    const auto usual = slots.empty()                         ? ""
                       : slots[0].kind == slot::Kind::Choice ? "on"
                                                             : slots[0].usual;
    if (!filling.is_empty(row.word))
      return std::nullopt;
    return Rephrased{values ? head + *values : fmt::format("{} {}", head, usual),
                     values && filling.is_sure()};
  }
  std::vector<std::string> values(slots.size());
  std::vector<std::string> open;
  std::optional<std::size_t> named;
  bool left = false;
  const bool aims = slots.size() == 2 && slots[0].most == spec::ball::full_circle - 1;
  const auto give = [&](const std::string& value, std::optional<std::size_t> at) {
    if (at && values[*at].empty())
      values[*at] = value;
    else
      open.push_back(value);
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto& piece = line[i];
    if (filling.is_used(i) || piece.is(Piece::Sign))
      continue;
    const auto turn =
        std::find_if(piece.meanings.begin(), piece.meanings.end(),
                     [](std::string_view one) { return one == "0" || one.ends_with("0"); });
    const bool turns = turn != piece.meanings.end();
    const bool names =
        i + 1 < line.size() && line[i + 1].is(Piece::Number) && slot_called(slots, piece);
    if (piece.is(Piece::Number) && (piece.most.is_bare() || piece.most.is(Measure::Percent) ||
                                    piece.most.is(Measure::Angle))) {
      auto value = piece.most.number;
      if (piece.most.is(Measure::Percent) && slots[slots.size() - 1].most == UINT8_MAX) {
        value = std::to_string(
            std::lround(std::clamp(piece.most.value(), 0.0, 100.0) * UINT8_MAX / 100));
        named = named ? named : slots.size() - 1;
      }
      give(value, named                                   ? named
                  : aims && piece.most.is(Measure::Angle) ? std::optional<std::size_t>(0)
                                                          : std::nullopt);
      named.reset();
    } else if (names) {
      named = slot_called(slots, piece);
    } else if (slots.size() == 3 && !piece.colour.empty()) {
      auto token = repair::word(piece.text);
      if (piece.text.starts_with('#'))
        token.kind = Token::Kind::Colour;
      for (const auto shift : {16U, 8U, 0U})
        open.push_back(std::to_string(repair::find_colour(token).value_or(0) >> shift & UINT8_MAX));
    } else if (turns && row.word == "spin") {
      left = left || *turn == "270";
    } else if (turns && aims) {
      give(std::string(*turn), 0);
    } else if (!holds("by to with", piece.text)) {
      continue;
    }
    filling.use(i);
  }
  if (!filling.is_empty(row.word))
    return std::nullopt;
  auto next = open.begin();
  for (auto& value : values)
    if (value.empty() && next != open.end())
      value = *next++;
  const auto lacking = std::count(values.begin(), values.end(), "");
  if (next != open.end() || lacking > 1 || (lacking == 1 && slots.size() != 2))
    return std::nullopt;
  const auto is_far = [](const std::string& value) { // a direction, not a byte
    return parse_number<int>(value).value_or(0) > UINT8_MAX;
  };
  const bool exchanged = aims && lacking == 0 && is_far(values[1]) && !is_far(values[0]);
  if (exchanged)
    std::swap(values[0], values[1]);
  if (aims)
    values[0] = values[0].empty() ? values[0] : in_circle(values[0]);
  if (left)
    values[0].insert(0, "-");
  std::string text;
  for (const auto& value : values)
    text += " " + value;
  if (lacking == 0)
    return Rephrased{head + text, filling.is_sure() && !exchanged};
  // Take a missing value from the default, or from the example.
  const auto example = words_in(row.example);
  const auto said = values[0].empty() ? values[1] : values[0];
  const auto behind = slots[1].usual.empty() ? example.back() : slots[1].usual;
  const auto with_last = fmt::format("{} {} {}", head, said, behind);
  const auto value = parse_number<int>(said).value_or(0);
  if (!aims || value > UINT8_MAX || value <= 0)
    return Rephrased{with_last, false};
  return Rephrased{fmt::format("{} {} {}", head, example[example.size() - 2], said), false,
                   with_last};
}

/// Reads a line below `prints`, or words for printing one.
std::optional<Rephrased> printed_line(const Tokens& line, Pieces pieces,
                                      const SurroundingText& elsewhere) {
  std::erase_if(pieces, [](const Piece& piece) { return piece.is(Piece::Sign); });
  const auto in_quotes = [](std::string_view text) { return fmt::format("\"{}\"", text); };
  if (pieces.size() == 2 && pieces[0].means("print") && is_whole_text(pieces[1])) {
    auto expected = "expect print " + pieces[1].text;
    return elsewhere.has_texts ? Rephrased{pieces[1].text, false, expected}
                               : Rephrased{expected, false};
  }
  if (pieces.size() == 1 && (line[0].is_text() || line[0].is_number()))
    return Rephrased{in_quotes(line[0].text), false};
  auto words = line;
  std::erase_if(words, [](const Token& token) { return token.is("[") || token.is("]"); });
  const bool lists =
      elsewhere.has_texts && words.size() > 1 && (line[0].is_number() || line[0].is("[")) &&
      std::all_of(words.begin(), words.end(),
                  [](const Token& token) { return token.is_word() || token.is_number(); });
  return lists ? std::optional(Rephrased{in_quotes(repair::join(words)), false}) : std::nullopt;
}

/// `run police.macro`: the extension tells what a file is for.
std::optional<Rephrased> file_line(const Pieces& pieces) {
  if (pieces.size() != 2 || !pieces[0].is(Piece::Word) || is_of_tests(pieces[0].text))
    return std::nullopt;
  const auto file = file_of(pieces[1]);
  if (file.empty())
    return std::nullopt;
  return file.ends_with(".svg") ? Rephrased{"course " + file, false}
                                : Rephrased{"program " + file, false, "with " + file};
}

} // namespace

std::vector<Rephrased> documented_forms(const Tokens& written, const SurroundingText& around) {
  const auto line = plain_line(written);
  const auto pieces = pieces_of(line);
  if (pieces.empty())
    return {};
  auto elsewhere = around;
  if (repair::has_token(written, "(")) { // the tolerance in a call belongs to another framework
    if (elsewhere.near_by.empty())
      elsewhere.near_by = slot::distance_by.usual;
    if (elsewhere.heading_by.empty())
      elsewhere.heading_by = slot::heading_by.usual;
  }
  Form form(elsewhere);
  const bool asks =
      any(pieces, [](const Piece& one) { return is_not(one) || one.means("expect"); });
  const bool acts = any(pieces, [](const Piece& piece) {
    return std::any_of(vm::stimulus_words.begin(), vm::stimulus_words.end(),
                       [&](const auto& row) { return equal_words(row.word, piece.text); });
  });
  const bool begins_with_time = pieces.size() > 1 && pieces[0].means("at") && pieces[1].is_time();
  auto found = printed_line(line, pieces, elsewhere);
  if (!found)
    found = form.setting(pieces);
  if (!found)
    found = file_line(pieces);
  if (!found && !asks)
    found = form.stimulus(pieces);
  if (!found && pieces.size() > 1 && (asks || !(acts || begins_with_time)))
    found = form.expectation(pieces);
  if (!found && repair::join(line) != repair::join(written))
    found = Rephrased{repair::join(line), true};
  return found ? std::vector{*std::move(found)} : std::vector<Rephrased>();
}

} // namespace orb::testing
