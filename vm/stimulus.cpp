#include "vm/stimulus.h"

#include "base/cursor.h"
#include "base/duration.h"
#include "base/meant.h"
#include "vm/rules.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace orb::vm {

namespace {

Stimulus stimulus_of(StimulusWord word, const std::vector<SlotValue>& values) {
  const auto whole = [&](std::size_t i) { return static_cast<int>(values[i].most); };
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(values[i].most); };
  const auto state = [&] { return values[0].which == 0 ? Switch::On : Switch::Off; };
  switch (word) {
  case StimulusWord::Wall:
    return Wall{values[0].text == "x" ? Wall::Axis::X : Wall::Axis::Y, values[0].most};
  case StimulusWord::Shake: return stimulus::Shake{};
  case StimulusWord::Toss: return stimulus::Toss{values[0].to};
  case StimulusWord::Push: return stimulus::Push{whole(0), whole(1)};
  case StimulusWord::Roll:
    return stimulus::ClientRoll{{whole(0), whole(1), whole(1) == 0 ? Go::Brake : Go::Drive}};
  case StimulusWord::Rgb: return stimulus::ClientColor{{byte(0), byte(1), byte(2)}};
  case StimulusWord::Connect: return stimulus::Connect{};
  case StimulusWord::Disconnect: return stimulus::Disconnect{};
  case StimulusWord::Battery: return stimulus::Battery{values[0].most};
  case StimulusWord::Charger: return stimulus::Charger{state()};
  case StimulusWord::Input: return stimulus::Number{whole(0)};
  case StimulusWord::Tilt: return stimulus::Tilt{values[0].most, values[1].most};
  case StimulusWord::Spin: return stimulus::Spin{values[0].most};
  case StimulusWord::Noise: return stimulus::Noise{state()};
  }
  return stimulus::Shake{};
}

Message event_help(std::string_view word) {
  std::vector<std::string_view> names;
  for (const auto& row : stimulus_words)
    names.push_back(row.word);
  return meant_or(word, names, texts::Events(fmt::format("{}", fmt::join(names, ", "))));
}

Message takes(const StimulusInfo& row) {
  return row.slots.empty()       ? texts::TakesNoValues(row.word)
         : row.slots.size() == 1 ? texts::TakesOneValue(row.word)
                                 : texts::TakesValues(row.word, row.slots.size());
}

} // namespace

void read_stimulus_line(const Source& source, std::uint32_t line, StimulusScript& script) {
  Cursor cursor(source, line, script.diagnostics, rules::StimulusArgument, rules::StimulusArgument);
  if (cursor.at_end())
    return;
  Duration at{};
  const auto first = cursor.peek_span();
  if (cursor.take_word("at")) {
    const auto span = cursor.peek_span();
    const auto time = parse_duration(cursor.word());
    if (!time || cursor.at_end())
      return cursor.fail_at(span.size() > 0 ? span : first, rules::StimulusSyntax,
                            texts::TakesTimeAndEvent("at"), texts::WriteLike("at 2.5s shake"));
    at = *time;
  }
  const auto span = cursor.peek_span();
  const auto word = cursor.word();
  const auto* const row = std::find_if(stimulus_words.begin(), stimulus_words.end(),
                                       [&](const auto& one) { return one.word == word; });
  if (row == stimulus_words.end()) {
    if (!parse_duration(word))
      return cursor.fail_at(span, rules::StimulusEvent, texts::NotAnEvent(word), event_help(word));
    cursor.take_rest();
    return cursor.fail_at(
        span, rules::StimulusSyntax, texts::TimeWithoutAt(word),
        texts::Write(fmt::format("at {}", source.text(cursor.span_from(span.begin)))));
  }
  const auto values = cursor.read(row->slots);
  if (!cursor.failed() && !cursor.at_end())
    cursor.fail(rules::StimulusArgument, takes(*row));
  if (!cursor.failed())
    script.events.push_back(
        {at, stimulus_of(static_cast<StimulusWord>(row - stimulus_words.begin()), values)});
}

StimulusScript parse_stimulus(const Source& source) {
  StimulusScript script;
  for (std::uint32_t line = 1; line <= source.line_count(); ++line)
    read_stimulus_line(source, line, script);
  sort_by_time(script.events);
  return script;
}

LiveStimulus read_live_stimulus(std::string_view line) {
  constexpr std::string_view at_now = "at now ";
  const bool is_now = line.starts_with(at_now);
  const Source source("line", std::string(is_now ? line.substr(at_now.size()) : line));
  return {parse_stimulus(source), is_now || !line.starts_with("at ")};
}

bool is_stimulus_line(std::string_view text) {
  return text.starts_with("at ") || text.starts_with("wall ");
}

void sort_by_time(std::vector<TimedStimulus>& script) {
  std::stable_sort(script.begin(), script.end(),
                   [](const auto& a, const auto& b) { return a.at < b.at; });
}

} // namespace orb::vm
