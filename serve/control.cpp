#include "serve/control.h"

#include "base/duration.h"
#include "base/render.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "base/text/utf8.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace orb::serve {
namespace {

constexpr std::string_view reset_word = "reset";
constexpr std::string_view state_word = "state";

/// Returns what precedes the first blank. The text must not begin with one.
std::string_view first_word(std::string_view text) {
  return text.substr(0, text.find_first_of(" \t"));
}

std::string not_a_line(std::string_view word) {
  std::vector<std::string_view> words;
  for (const auto& row : vm::stimulus_words)
    words.push_back(row.word);
  words.insert(words.end(), {reset_word, state_word});
  return fmt::format(
      "`{}` is nothing that can be asked; {}", to_printable(word),
      did_you_mean(word, words, fmt::format("write one of {}", fmt::join(words, ", "))));
}

tl::expected<decltype(Control::what), std::string> read_event(std::string_view text) {
  const auto [script, at_once] = vm::read_live_stimulus(text);
  if (!script.diagnostics.empty())
    return tl::unexpected(to_printable(in_one_line(script.diagnostics.front())));
  if (script.events.empty())
    return tl::unexpected(not_a_line(text));
  const auto& event = script.events.front();
  if (at_once)
    return Control::Now{event.stimulus};
  return event;
}

} // namespace

tl::expected<std::optional<Control>, std::string> parse_control(std::string_view line, int balls) {
  auto text = trim(line.substr(0, line.find('#')));
  if (text.empty())
    return std::nullopt;
  Control control;
  if (const auto number = parse_number<int>(first_word(text))) {
    if (*number < 1 || *number > balls)
      return tl::unexpected(
          balls == 1 ? fmt::format("there is no ball {}, only one; write the "
                                   "line without a number",
                                   *number)
                     : fmt::format("there is no ball {}; the balls are 1 to {}", *number, balls));
    control.ball = *number;
    text = trim(text.substr(first_word(text).size()));
    if (text.empty())
      return tl::unexpected(
          fmt::format("write what is asked of ball {0}, as in `{0} state`", *control.ball));
  }
  const auto word = first_word(text);
  if (text == reset_word || text == state_word) {
    if (text == reset_word)
      control.what = Control::Reset{};
    else
      control.what = Control::StateQuery{};
    return control;
  }
  if (word == reset_word || word == state_word)
    return tl::unexpected(fmt::format("`{0}` takes no values; write `{0}`", word));
  const bool is_known =
      word == "at" || parse_duration(word) ||
      std::ranges::any_of(vm::stimulus_words, [&](const auto& row) { return row.word == word; });
  if (!is_known)
    return tl::unexpected(not_a_line(word));
  auto event = read_event(text);
  if (!event)
    return tl::unexpected(event.error());
  control.what = *std::move(event);
  return control;
}

} // namespace orb::serve
