#include "testing/text/documented_form.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/idioms.h"
#include "testing/text/plain_line.h"
#include "testing/text/vocabulary.h"
#include "vm/stimulus.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::testing {
namespace {

using repair::Rephrased;
using repair::Token;
using repair::Tokens;

/// What is expected, without `expect`.
struct State {
  const ExpectationInfo* first = nullptr;
  const ExpectationInfo* last = nullptr;
  std::string text;
  std::string lasts; ///< ` for 2s`
  std::string lag;   ///< in front of `after`
  std::optional<Moment> when;
  std::vector<std::string> more; ///< what needs lines of its own
  bool never = false;
  bool sure = true;
};

bool is_not(const Piece& piece) {
  return piece.is(Piece::Word) && piece.means_any("not never");
}

/// The word that a line begins with, or that says what happens, after words that say nothing.
std::size_t first_said(const Pieces& pieces) {
  std::size_t at = 0;
  while (at < pieces.size() && pieces[at].says_nothing() && !pieces[at].means_any("at for"))
    ++at;
  return at;
}

class Form {
public:
  explicit Form(const Elsewhere& elsewhere) : elsewhere_(elsewhere) {}

  std::optional<Rephrased> expectation(const Pieces& line) {
    auto all = line;
    const auto negations = std::erase_if(all, is_not);
    for (auto& piece : all) // `not.toContain("thrown")`
      if (negations > 0 && !piece.inner.empty() && piece.text[0] == '"' &&
          std::any_of(all.begin(), all.end(), [](const Piece& one) { return one.means("~"); }))
        piece.text.insert(0, "~");
    asks_ = negations > 0;
    while (!all.empty() && (all[0].is(Piece::Sign) || all[0].means("expect") ||
                            holds("and then", lower(all[0].text)) ||
                            (all[0].says_nothing() && all.size() > 1 && all[1].means("expect")))) {
      asks_ = asks_ || all[0].means("expect");
      all.erase(all.begin());
    }
    const bool wrong = std::erase_if(all, [](const Piece& piece) {
                         return piece.is(Piece::Word) && equal_words(piece.text, "false");
                       }) > 0;
    const bool never = (negations > 0) != wrong;
    if (all.empty())
      return std::nullopt;
    if (!never)
      if (auto lines = printed_lines(all))
        return lines;
    auto state = joined(all, nullptr);
    if (!state || (state->lag.size() > 0 && never))
      return std::nullopt;
    state->never = never;
    const bool reach = state->text.starts_with("reach ") && !never && state->first == state->last &&
                       state->more.empty() && state->text.find(' ', 6) == std::string::npos;
    return written(*state, reach ? "" : never ? "never " : "expect ");
  }

  std::optional<Rephrased> stimulus(const Pieces& line) {
    for (std::size_t i = 0; i < line.size(); ++i)
      for (const auto& row : vm::stimulus_words)
        if (line[i].is(Piece::Word) && line[i].means(row.word))
          if (auto one = row.word == "wall" ? walls(line, i) : happens(line, i, row))
            return one;
    return std::nullopt;
  }

  /// A line of the head, or `test`.
  std::optional<Rephrased> setting(const Pieces& line) {
    for (const auto& row : line_words) {
      if (row.slots.empty() || row.slots[0].kind == slot::Kind::Rest)
        continue;
      const auto at = first_said(line);
      const bool named = at < line.size() && line[at].is(Piece::Word) && line[at].means(row.word);
      if (!named)
        continue;
      Filling filling(line, elsewhere_);
      const auto values = filling.fill(row.slots, at);
      if (values && filling.is_empty(row.word))
        return Rephrased{fmt::format("{}{}", row.word, *values), filling.is_sure()};
    }
    return std::nullopt;
  }

private:
  /// Rows that a line without their word can mean, the likeliest first.
  static std::vector<const ExpectationInfo*> implied() {
    return {&info(Word::Variable), &info(Word::Color), &info(Word::Print),
            &info(Word::Beyond),   &info(Word::Near)};
  }

  /// What pieces expect that nothing joins. `like` is what was expected before.
  std::optional<State> single(const Pieces& pieces, const ExpectationInfo* like) {
    if (--budget_ < 0)
      return std::nullopt;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (const auto meaning : pieces[i].meanings) {
        const bool reach = meaning == info(LineWord::Reach).word;
        for (const auto& row : expectations)
          if (&row != &info(Word::Variable) &&
              (row.word == meaning || (reach && &row == &info(Word::Inside))))
            if (auto state = filled(pieces, row, i, reach ? meaning : row.word))
              return state;
      }
    auto rows = implied();
    if (depth_ == 0 && elsewhere_.has_course && is_zone(pieces))
      rows.push_back(&info(Word::Inside));
    if (like != nullptr)
      rows.insert(rows.begin(), like);
    for (const auto* row : rows)
      if (auto state = filled(pieces, *row, SIZE_MAX, row->word))
        return state;
    return std::nullopt;
  }

  std::optional<State> filled(const Pieces& pieces, const ExpectationInfo& row, std::size_t subject,
                              std::string_view word) {
    Filling filling(pieces, elsewhere_);
    const bool variable = &row == &info(Word::Variable);
    const bool implied_ = subject == SIZE_MAX;
    if (implied_ && &row == &info(Word::Print) && !asks_ &&
        std::none_of(pieces.begin(), pieces.end(),
                     [](const Piece& piece) { return piece.text.starts_with('~'); }))
      return std::nullopt; // a line that is printed
    if (variable && (!implied_ || pieces.size() < 2 || !pieces[0].is(Piece::Word)))
      return std::nullopt;
    State state;
    const auto values = filling.fill(row.slots, subject);
    if (!values)
      return std::nullopt;
    state.first = state.last = &row;
    state.text = variable ? values->substr(1) : fmt::format("{}{}", word, *values);
    if (&row == &info(Word::Error))
      state.text += error(filling);
    std::string times;
    if (row.kind == Kind::Event && has_count(filling))
      times = filling.take_times();
    if (!filling.take_when(state.when, state.lasts))
      return std::nullopt;
    if (row.kind == Kind::Event && times.empty() && depth_ == 0)
      times = filling.take_times();
    state.text += times;
    if (!filling.is_empty(word))
      return std::nullopt;
    if (variable)
      state.when = Moment{"at", "end"};
    state.sure = filling.is_sure() && !(implied_ && &row == &info(Word::Inside));
    return state;
  }

  static bool has_count(const Filling& filling) {
    return std::any_of(filling.pieces().begin(), filling.pieces().end(),
                       [](const Piece& piece) { return piece.is_count; });
  }

  /// Whether a word can be the name of a zone alone: none that is nearly one of tests.
  static bool is_zone(const Pieces& pieces) {
    const auto name = std::find_if(pieces.begin(), pieces.end(), [](const Piece& piece) {
      return piece.is(Piece::Word) && piece.meanings.empty() && piece.colour.empty();
    });
    if (std::any_of(pieces.begin(), pieces.end(),
                    [](const Piece& one) { return !one.sign.empty(); }))
      return false;
    std::vector<std::string_view> words;
    for (const auto& row : expectations)
      words.push_back(row.word);
    return name != pieces.end() && name->text.size() > 1 && !closest(name->text, words);
  }

  /// The name of an error: words up to what says when.
  static std::string error(Filling& filling) {
    std::string all;
    for (std::size_t i = 0; i < filling.pieces().size(); ++i) {
      const auto& piece = filling.pieces()[i];
      if (filling.is_used(i))
        continue;
      const bool number = piece.is(Piece::Number) && piece.most.is_bare() && !piece.is_count;
      const bool name = piece.is(Piece::Word) && piece.meanings.empty();
      if (!number && !name && !piece.is(Piece::Text))
        break;
      filling.use(i);
      all += " " + (number ? piece.most.number : piece.text);
    }
    return all;
  }

  static bool expects(const Piece& piece) {
    return std::any_of(expectations.begin(), expectations.end(),
                       [&](const ExpectationInfo& row) { return piece.means(row.word); });
  }

  static bool is_joint(const Pieces& pieces, std::size_t at) {
    const auto& piece = pieces[at];
    if (piece.is(Piece::Sign)) {
      const auto& next = pieces[std::min(at + 1, pieces.size() - 1)];
      return piece.text == "," && (!next.colour.empty() || next.is(Piece::Text) || expects(next));
    }
    if (!piece.is(Piece::Word))
      return false;
    const bool of_time = at + 1 < pieces.size() && pieces[at + 1].is_time();
    return piece.means("and") || piece.means("before") || piece.means("then") ||
           equal_words(piece.text, "or") || piece.means("until") ||
           (piece.means("after") && !of_time);
  }

  /// What pieces expect, perhaps several things: at once, or one before the other.
  std::optional<State> joined(const Pieces& pieces, const ExpectationInfo* like) {
    if (auto one = single(pieces, like))
      return one;
    for (std::size_t at = 1; at + 1 < pieces.size(); ++at)
      if (is_joint(pieces, at))
        if (auto state = join(pieces, at, at + 1, pieces[at], like))
          return state;
    static const Piece both{Piece::Word, "and", {"and"}};
    for (std::size_t at = 2; at < pieces.size(); ++at) // `inside garage color green`
      if (expects(pieces[at]) && is_of_tests(pieces[at].text))
        if (auto state = join(pieces, at, at, both, like))
          return state;
    return std::nullopt;
  }

  std::optional<State> join(const Pieces& pieces, std::size_t end, std::size_t begin,
                            const Piece& joint, const ExpectationInfo* like) {
    auto left_pieces = Pieces(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(end));
    std::string lag;
    if (joint.means("after") && left_pieces.back().is_time() && left_pieces.size() > 1) {
      Filling lone({left_pieces.back()}, elsewhere_);
      lag = lone.time(left_pieces.back().most);
      left_pieces.pop_back();
    }
    ++depth_;
    auto left = single(left_pieces, like);
    if (!left)
      return --depth_, std::nullopt;
    auto rest = Pieces(pieces.begin() + static_cast<std::ptrdiff_t>(begin), pieces.end());
    bool then = joint.means("then");
    while (!rest.empty() && (rest[0].means_any("then and expect"))) {
      then = then || rest[0].means("then");
      rest.erase(rest.begin());
    }
    Piece by;
    if (!lag.empty())
      for (std::size_t i = 1; i < rest.size(); ++i)
        if (rest[i].is_time() && rest[i - 1].means("by")) {
          by = rest[i];
          rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i) - 1,
                     rest.begin() + static_cast<std::ptrdiff_t>(i) + 1);
          break;
        }
    auto right = rest.empty() ? std::nullopt : joined(rest, left->last);
    --depth_;
    if (!right || (left->when && right->when) || (!left->lasts.empty() && !right->lasts.empty()))
      return std::nullopt;
    auto when = left->when ? left->when : right->when;
    const bool and_ = !then && (joint.is(Piece::Sign) || joint.means("and"));
    State state = *left;
    state.sure = left->sure && right->sure;
    state.last = right->last;
    state.more = right->more;
    state.lasts = left->lasts.empty() ? right->lasts : left->lasts;
    state.when = when;
    if (equal_words(joint.text, "or") || (and_ && right->first->kind == Kind::Event)) {
      if (equal_words(joint.text, "or"))
        state.lag = "or";
      state.last = left->last;
      state.more.insert(state.more.begin(), right->text);
      return state;
    }
    if (and_) {
      state.text += " and " + right->text;
      return state;
    }
    const bool after = joint.means("after");
    if (!after && when)
      return std::nullopt;
    if (!lag.empty()) {
      std::string tolerance = "200ms";
      if (by.is_time())
        tolerance = by.most.number + std::string(by.most.unit->word);
      state.text += fmt::format(" {} after {} by {}", lag, right->text, tolerance);
    } else {
      state.text += fmt::format(" {} {}", after ? "after" : "before", right->text);
      state.sure = state.sure && !then;
    }
    return state;
  }

  /// Moment an expectation of that kind can say that it is; empty for no time at all.
  std::string when_of(const State& state) const {
    if (!state.when)
      return {};
    const auto& [word, time] = *state.when;
    const auto kind = state.first->kind;
    const bool at_end = time == "end";
    const auto plain = fmt::format("{} {}", word, time);
    const auto so_long = "during 0s.." + time;
    if (word == "after" && kind == Kind::State && !state.never)
      return "at " + time;
    if (word == "after" && (kind == Kind::State || kind == Kind::Event))
      return fmt::format("during {}..{}s", time, (elsewhere_.bound + 999ms) / Duration{1s});
    switch (kind) {
    case Kind::State:
    case Kind::Stay: return state.never && word == "within" ? so_long : plain;
    case Kind::Event:
      if (state.never && (word == "within" || (word == "at" && !at_end)))
        return so_long;
      return at_end ? std::string() : word == "at" ? "within " + time : plain;
    case Kind::End: {
      const auto dots = time.find("..");
      return at_end ? plain
                    : "within " + (dots == std::string::npos ? time : time.substr(dots + 2));
    }
    case Kind::Output: return {};
    case Kind::Final: return at_end ? plain : std::string();
    }
    return plain;
  }

  std::optional<Rephrased> written(State state, std::string_view verb) {
    if (state.lag == "or" && !state.never)
      return std::nullopt;
    const auto line = [&](const std::string& when) {
      std::string all;
      auto texts = state.more;
      texts.insert(texts.begin(), state.text);
      for (const auto& text : texts)
        all += fmt::format("{}{}{}{}{}{}{}", all.empty() ? "" : "\n", verb, text,
                           state.lasts.empty() ? "" : " for ", state.lasts, when.empty() ? "" : " ",
                           when);
      return all;
    };
    const auto& row = *state.first;
    if (row.kind == Kind::End && elsewhere_.has_bound && (!state.when || state.when->time == "end"))
      return Rephrased{line(fmt::format("within {}s", (elsewhere_.bound + 999ms) / Duration{1s})),
                       false};
    if (state.when && (state.when->word.empty() || state.when->word == "until")) {
      const auto& time = state.when->time;
      const auto so_long = line("during 0s.." + time);
      const auto within = line("within " + time);
      if (state.when->word.empty()) // which of `at` and `within` is not said
        return state.never               ? Rephrased{so_long, false}
               : row.kind == Kind::State ? Rephrased{line("at " + time), false, within}
                                         : Rephrased{within, false};
      return row.kind != Kind::State ? Rephrased{within, true}
             : state.never           ? Rephrased{so_long, true}
                                     : Rephrased{so_long, false, within};
    }
    return Rephrased{line(when_of(state)),
                     state.sure && !(state.when && state.when->word == "after")};
  }

  /// Several texts are the lines that are printed, one below the other; one is the first of them
  /// where others stand below.
  std::optional<Rephrased> printed_lines(const Pieces& pieces) const {
    std::string all;
    std::size_t count = 0;
    bool says = false;
    bool lists = false;
    for (const auto& piece : pieces) {
      if (piece.is(Piece::Text) && !piece.inner.empty() && piece.text[0] == '"' && says) {
        all += "\n" + piece.text;
        ++count;
      } else if (piece.means_any("print prints")) {
        says = true;
        lists = lists || piece.means("prints");
      } else if (!piece.is(Piece::Sign) && !piece.says_nothing() &&
                 !holds("toEqual toBe equals using", piece.text)) {
        return std::nullopt;
      }
    }
    if (!says || (count == 0 && !elsewhere_.has_texts) ||
        (count == 1 && !(lists && elsewhere_.has_texts)))
      return std::nullopt;
    return Rephrased{"expect prints" + all, count > 0};
  }

  std::optional<Rephrased> walls(const Pieces& line, std::size_t subject) {
    Filling filling(line, elsewhere_);
    const auto& row = vm::stimulus_words[0];
    std::string all;
    for (auto values = filling.fill(row.slots, subject); values;
         values = filling.fill(row.slots, subject))
      all += fmt::format("{}{}{}", all.empty() ? "" : "\n", row.word, *values);
    return all.empty() || !filling.is_empty(row.word) ? std::nullopt
                                                      : std::optional(Rephrased{all, true});
  }

  std::optional<Rephrased> happens(const Pieces& line, std::size_t subject,
                                   const vm::StimulusInfo& row);

  const Elsewhere& elsewhere_;
  bool asks_ = false; ///< it says `expect`, or a word for it
  int depth_ = 0;     ///< of what is joined
  int budget_ = 200;  ///< attempts in one line
};

/// The pieces of a stimulus with its numbers in the order of its slots: names, units and directions
/// tell which is which.
Pieces in_order(const Pieces& line, std::size_t subject, const vm::StimulusInfo& row) {
  Pieces words;
  std::vector<std::optional<Piece>> slots(row.slots.size());
  std::vector<Piece> open;
  bool turns_left = false;
  std::optional<std::size_t> named;
  const auto add = [&](Piece piece, std::optional<std::size_t> at) {
    if (at && !slots[*at])
      slots[*at] = std::move(piece);
    else
      open.push_back(std::move(piece));
  };
  const auto slot_called = [&](const Piece& piece) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < row.slots.size(); ++i)
      if (row.slots.size() > 1 && piece.is(Piece::Word) &&
          (equal_words(row.slots[i].called->english, piece.text) ||
           repair::is_called(row.slots[i].called->english, piece.text)))
        return i;
    return std::nullopt;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    auto piece = line[i];
    const bool number = piece.is(Piece::Number) && !piece.is_time() && !piece.is_count;
    const auto next =
        i + 1 < line.size() && line[i + 1].is(Piece::Number) && !line[i + 1].is_time();
    const auto direction =
        std::find_if(piece.meanings.begin(), piece.meanings.end(), [](std::string_view one) {
          return holds("0 90 180 270", one) && !one.empty();
        });
    if (i == subject) {
      words.push_back(piece);
    } else if (number) {
      if (piece.most.is(Measure::Percent) && row.slots.size() > 1) {
        for (std::size_t at = 0; at < row.slots.size(); ++at)
          if (row.slots[at].most == UINT8_MAX && !named)
            named = at;
        piece.most.number = std::to_string(
            std::lround(std::clamp(piece.most.value(), 0.0, 1000.0) * UINT8_MAX / 100));
      }
      const bool angle = piece.most.is(Measure::Angle) && row.slots.size() == 2;
      piece.most.unit = nullptr;
      piece.sign.clear();
      add(piece, named ? named : angle ? std::optional<std::size_t>(0) : std::nullopt);
      named.reset();
    } else if (next && slot_called(piece)) {
      named = slot_called(piece);
    } else if (row.slots.size() == 3 && !piece.colour.empty()) {
      Token token = repair::word(piece.text);
      if (piece.text.starts_with('#'))
        token.kind = Token::Kind::Colour;
      const auto rgb = repair::find_colour(token).value_or(0);
      for (const auto shift : {16U, 8U, 0U}) {
        Piece channel{Piece::Number, {}};
        channel.most.number = std::to_string(rgb >> shift & UINT8_MAX);
        open.push_back(channel);
      }
    } else if (direction != piece.meanings.end() && row.word == "spin") {
      turns_left = turns_left || *direction == "270";
    } else if (direction != piece.meanings.end() && row.slots.size() == 2 &&
               row.slots[0].least == 0) {
      Piece angle{Piece::Number, {}};
      angle.most.number = *direction;
      add(angle, 0);
    } else if (!piece.is(Piece::Word) || !holds("by to with", piece.text)) {
      words.push_back(piece);
    }
  }
  auto from_open = open.begin();
  for (auto& slot : slots)
    if (!slot && from_open != open.end())
      slot = *from_open++;
  for (auto& slot : slots)
    if (slot) {
      if (turns_left)
        slot->most.number.insert(0, "-");
      words.push_back(*slot);
    }
  words.insert(words.end(), from_open, open.end()); // too many
  return words;
}

std::optional<Rephrased> Form::happens(const Pieces& line, std::size_t subject,
                                       const vm::StimulusInfo& row) {
  const auto& slots = row.slots;
  const bool takes_time = !slots.empty() && slots[0].kind == slot::Kind::Time;
  Filling first(line, elsewhere_);
  first.use(subject);
  auto head = first.take_moment(takes_time);
  head += row.word;
  Pieces left;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (!first.is_used(i) || i == subject)
      left.push_back(line[i]);
  const auto word = static_cast<std::size_t>(std::find_if(left.begin(), left.end(),
                                                          [&](const Piece& one) {
                                                            return &one - left.data() >= 0 &&
                                                                   one.text == line[subject].text;
                                                          }) -
                                             left.begin());
  auto pieces = slots.empty() ? left : in_order(left, word, row);
  const auto at = static_cast<std::size_t>(
      std::find_if(pieces.begin(), pieces.end(),
                   [&](const Piece& one) { return one.text == line[subject].text; }) -
      pieces.begin());
  Filling filling(pieces, elsewhere_);
  if (auto values = filling.fill(slots, at); values && filling.is_empty(row.word))
    return Rephrased{head + *values, first.is_sure() && filling.is_sure()};
  // What lacks is as usual, or as in the example.
  std::vector<std::string> usual;
  const auto example = words_in(row.example);
  for (std::size_t i = 0; i < slots.size(); ++i)
    usual.emplace_back(slots[i].kind == slot::Kind::Choice ? "on"
                       : !slots[i].usual.empty()           ? slots[i].usual
                       : slots.size() == 2                 ? example[example.size() - 2 + i]
                                                           : "");
  std::vector<std::string> given;
  Filling some(pieces, elsewhere_);
  some.use(at);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i].is(Piece::Number) && pieces[i].most.is_bare()) {
      given.push_back(pieces[i].most.number);
      some.use(i);
    }
  const auto said = given.empty() ? std::string() : given[0];
  if (given.size() + 1 != slots.size() || !some.is_empty(row.word) || usual.back().empty())
    return std::nullopt;
  if (slots.size() == 1)
    return Rephrased{fmt::format("{} {}", head, usual[0]), false};
  const auto with_last = fmt::format("{} {} {}", head, said, usual[1]);
  const auto with_first = fmt::format("{} {} {}", head, usual[0], said);
  const auto value = parse_number<int>(said).value_or(0);
  if (!slots[1].usual.empty() || value > UINT8_MAX || value <= 0)
    return Rephrased{with_last, false};
  return Rephrased{with_first, false, with_last};
}

/// A line of those below `prints`, or the words that print one.
std::optional<Rephrased> printed_line(const Tokens& line, const Pieces& pieces,
                                      const Elsewhere& elsewhere) {
  const auto quoted = [](std::string_view text) { return fmt::format("\"{}\"", text); };
  const bool says = pieces.size() == 2 && pieces[0].means("print") && !pieces[1].inner.empty() &&
                    pieces[1].text[0] == '"';
  if (says && elsewhere.has_texts)
    return Rephrased{pieces[1].text, false, "expect print " + pieces[1].text};
  if (says)
    return Rephrased{"expect print " + pieces[1].text, false};
  const auto parts = std::count_if(pieces.begin(), pieces.end(),
                                   [](const Piece& piece) { return !piece.is(Piece::Sign); });
  if (parts == 1 && (line[0].is_text() || line[0].is_number()))
    return Rephrased{quoted(line[0].text), false};
  auto words = line;
  std::erase_if(words, [](const Token& token) { return token.is("[") || token.is("]"); });
  const bool lists =
      elsewhere.has_texts && words.size() > 1 && (line[0].is_number() || line[0].is("[")) &&
      std::none_of(words.begin(), words.end(),
                   [](const Token& token) { return !(token.is_word() || token.is_number()); });
  return lists ? std::optional(Rephrased{quoted(repair::join(words)), false}) : std::nullopt;
}

/// `run police.macro`: what a file is for is told by its ending.
std::optional<Rephrased> file_line(const Pieces& pieces) {
  std::string file;
  std::size_t words = 0;
  for (const auto& piece : pieces) {
    const bool names = piece.is(Piece::File) || is_file(piece.inner);
    if (names && file.empty())
      file = piece.is(Piece::File) ? piece.text : piece.inner;
    else if (!piece.is(Piece::Word) || !file.empty() || ++words > 1 || is_of_tests(piece.text))
      return std::nullopt;
  }
  if (file.empty() || words != 1)
    return std::nullopt;
  if (file.ends_with(".svg"))
    return Rephrased{"course " + file, false};
  return Rephrased{"program " + file, false, "with " + file};
}

} // namespace

std::vector<Rephrased> documented_forms(const Tokens& written, const Elsewhere& around) {
  const auto line = plain_line(written);
  const auto pieces = pieces_of(line);
  if (pieces.empty())
    return {};
  auto elsewhere = around;
  if (repair::has_token(written, "(")) { // a call has no tolerance of ours
    if (elsewhere.near_by.empty())
      elsewhere.near_by = slot::distance_by.usual;
    if (elsewhere.heading_by.empty())
      elsewhere.heading_by = slot::heading_by.usual;
  }
  std::vector<Rephrased> all;
  const auto add = [&](std::optional<Rephrased> one) {
    if (one && all.empty())
      all.push_back(std::move(*one));
  };
  Form form(elsewhere);
  add(printed_line(line, pieces, elsewhere));
  add(form.setting(pieces));
  add(file_line(pieces));
  const bool asks = std::any_of(pieces.begin(), pieces.end(), [](const Piece& piece) {
    return is_not(piece) || (piece.is(Piece::Word) && piece.means("expect"));
  });
  if (all.empty() && !asks)
    add(form.stimulus(pieces));
  const bool acts = std::any_of(pieces.begin(), pieces.end(), [](const Piece& piece) {
    return std::any_of(vm::stimulus_words.begin(), vm::stimulus_words.end(),
                       [&](const auto& row) { return equal_words(row.word, piece.text); });
  });
  const bool begins_with_time = pieces.size() > 1 && pieces[0].means("at") && pieces[1].is_time();
  if (all.empty() && pieces.size() > 1 && (asks || !(acts || begins_with_time)))
    add(form.expectation(pieces));
  if (all.empty() && repair::join(line) != repair::join(written))
    all.push_back({repair::join(line), true});
  return all;
}

} // namespace orb::testing
