#include "vm/stimulus.h"

#include "base/duration.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "base/text/utf8.h"
#include "vm/rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <type_traits>

namespace orb::vm {

namespace {

struct Word {
  std::string_view text;
  Span span;
};

std::vector<Word> words_of(const Source& source, std::uint32_t line) {
  std::vector<Word> words;
  const auto text = source.line(line);
  const auto start = source.line_start(line);
  auto at = byte_order_mark_size(text);
  while (at < text.size() && text[at] != '#') {
    if (text[at] == ' ' || text[at] == '\t') {
      ++at;
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" \t#", at), text.size());
    words.push_back(
        {text.substr(at, end - at),
         {start + static_cast<std::uint32_t>(at), start + static_cast<std::uint32_t>(end)}});
    at = end;
  }
  return words;
}

/// A decimal number that is the whole word. Limited to what a script can mean, so that no
/// arithmetic on it overflows.
std::optional<double> number(std::string_view text, double least, double greatest) {
  const auto value = parse_number<double>(text, std::chars_format::fixed);
  return value && *value >= least && *value <= greatest ? value : std::nullopt;
}

std::optional<int> integer(std::string_view text, int least, int greatest) {
  const auto value = parse_number<int>(text);
  return value && *value >= least && *value <= greatest ? value : std::nullopt;
}

/// Reads the arguments of one event, remembering the first that is wrong.
class Arguments {
public:
  Arguments(std::span<const Word> words) : words_(words) {}

  int whole(std::string_view what, int least, int greatest) {
    return take(what, fmt::format("{} to {}", least, greatest),
                [&](std::string_view text) { return integer(text, least, greatest); })
        .value_or(0);
  }
  double real(std::string_view what, double least, double greatest) {
    return take(what, fmt::format("{} to {}", least, greatest),
                [&](std::string_view text) { return number(text, least, greatest); })
        .value_or(0);
  }
  Duration time(std::string_view what) {
    return take(what, "a time such as 800ms or 2.5s",
                [](std::string_view text) { return parse_duration(text); })
        .value_or(Duration{});
  }
  Switch on_off(std::string_view what) {
    return take(what, "on or off",
                [](std::string_view text) -> std::optional<Switch> {
                  if (text == "on")
                    return Switch::On;
                  if (text == "off")
                    return Switch::Off;
                  return std::nullopt;
                })
        .value_or(Switch::Off);
  }
  Wall wall() {
    return take("wall", "x=CENTIMETRES or y=CENTIMETRES",
                [](std::string_view text) -> std::optional<Wall> {
                  if (!text.starts_with("x=") && !text.starts_with("y="))
                    return std::nullopt;
                  const auto at = number(text.substr(2), -1e6, 1e6);
                  if (!at)
                    return std::nullopt;
                  return Wall{text[0] == 'x' ? Wall::Axis::X : Wall::Axis::Y, *at};
                })
        .value_or(Wall{});
  }

  std::size_t taken() const { return next_; }
  const std::string& problem() const { return problem_; }
  std::optional<Span> where() const { return where_; }

private:
  template <class Read>
  std::invoke_result_t<Read, std::string_view> take(std::string_view what, std::string wanted,
                                                    Read read) {
    std::invoke_result_t<Read, std::string_view> value;
    if (next_ < words_.size())
      value = read(words_[next_].text);
    if (!value && problem_.empty()) {
      problem_ = next_ < words_.size() ? fmt::format("the {} must be {}, found `{}`", what, wanted,
                                                     words_[next_].text)
                                       : fmt::format("missing {}: expected {}", what, wanted);
      if (next_ < words_.size())
        where_ = words_[next_].span;
    }
    ++next_;
    return value;
  }

  std::span<const Word> words_;
  std::size_t next_ = 0;
  std::string problem_;
  std::optional<Span> where_;
};

/// One for each row of vm/stimulus.def, in its order.
struct EventRow {
  std::string_view word;
  Stimulus (*read)(Arguments&);
};

using namespace spec::ball;

constexpr int heading_most = full_circle - 1;
constexpr int byte_most = greatest;

// clang-format off
constexpr std::array events{
    EventRow{"wall", [](Arguments& a) -> Stimulus { return a.wall(); }},
    EventRow{"shake", [](Arguments&) -> Stimulus { return stimulus::Shake{}; }},
    EventRow{"toss", [](Arguments& a) -> Stimulus { return stimulus::Toss{a.time("time")}; }},
    EventRow{"push", [](Arguments& a) -> Stimulus {
      const int heading = a.whole("heading", 0, heading_most);
      return stimulus::Push{heading, a.whole("strength", 0, byte_most)};
    }},
    EventRow{"roll", [](Arguments& a) -> Stimulus {
      const int heading = a.whole("heading", 0, heading_most);
      const int speed = a.whole("speed", 0, byte_most);
      return stimulus::ClientRoll{{heading, speed, speed == 0 ? Go::Brake : Go::Drive}};
    }},
    EventRow{"rgb", [](Arguments& a) -> Stimulus {
      const auto red = static_cast<std::uint8_t>(a.whole("red", 0, byte_most));
      const auto green = static_cast<std::uint8_t>(a.whole("green", 0, byte_most));
      const auto blue = static_cast<std::uint8_t>(a.whole("blue", 0, byte_most));
      return stimulus::ClientColor{{red, green, blue}};
    }},
    EventRow{"connect", [](Arguments&) -> Stimulus { return stimulus::Connect{}; }},
    EventRow{"disconnect", [](Arguments&) -> Stimulus { return stimulus::Disconnect{}; }},
    EventRow{"battery", [](Arguments& a) -> Stimulus { return stimulus::Battery{a.real("voltage", 0, 10)}; }},
    EventRow{"charger", [](Arguments& a) -> Stimulus { return stimulus::Charger{a.on_off("state")}; }},
    EventRow{"input", [](Arguments& a) -> Stimulus {
      return stimulus::Number{a.whole("number", INT32_MIN, INT32_MAX)};
    }},
    EventRow{"tilt", [](Arguments& a) -> Stimulus {
      const double pitch = a.real("pitch", -full_circle / 4, full_circle / 4);
      return stimulus::Tilt{pitch, a.real("roll", -full_circle / 2, full_circle / 2)};
    }},
    EventRow{"spin", [](Arguments& a) -> Stimulus { return stimulus::Spin{a.real("rate", -greatest_yaw_rate, greatest_yaw_rate)}; }},
    EventRow{"noise", [](Arguments& a) -> Stimulus { return stimulus::Noise{a.on_off("state")}; }},
};
// clang-format on
static_assert(events.size() == stimulus_words.size());
static_assert([] {
  for (std::size_t i = 0; i < events.size(); ++i)
    if (events[i].word != stimulus_words[i].word)
      return false;
  return true;
}());

std::string event_help(std::string_view word) {
  std::vector<std::string_view> names;
  for (const auto& row : events)
    names.push_back(row.word);
  return did_you_mean(word, names, fmt::format("the events are {}", fmt::join(names, ", ")));
}

} // namespace

void read_stimulus_line(const Source& source, std::uint32_t line, StimulusScript& script) {
  const auto words = words_of(source, line);
  if (words.empty())
    return;
  std::span<const Word> rest{words};
  Duration at{};
  if (rest[0].text == "at") {
    const auto time = rest.size() > 1 ? parse_duration(rest[1].text) : std::nullopt;
    if (!time || rest.size() < 3) {
      script.diagnostics.push_back(
          finding(rules::StimulusSyntax, rest[rest.size() > 1 ? 1 : 0].span,
                  "`at` takes a time and an event", "write it like `at 2.5s shake`"));
      return;
    }
    at = *time;
    rest = rest.subspan(2);
  }
  const auto row = std::find_if(events.begin(), events.end(),
                                [&](const auto& event) { return event.word == rest[0].text; });
  if (row == events.end()) {
    const bool early_time = parse_duration(rest[0].text).has_value();
    script.diagnostics.push_back(
        early_time
            ? finding(rules::StimulusSyntax, rest[0].span,
                      fmt::format("a time without `at`: `{}`", rest[0].text),
                      fmt::format("write `at {}`",
                                  source.text({rest[0].span.begin, rest.back().span.end})))
            : finding(rules::StimulusEvent, rest[0].span,
                      fmt::format("`{}` is not an event", rest[0].text), event_help(rest[0].text)));
    return;
  }
  Arguments arguments{rest.subspan(1)};
  const auto stimulus = row->read(arguments);
  if (!arguments.problem().empty()) {
    script.diagnostics.push_back(finding(rules::StimulusArgument,
                                         arguments.where().value_or(rest[0].span),
                                         fmt::format("`{}`: {}", row->word, arguments.problem())));
    return;
  }
  if (arguments.taken() + 1 < rest.size()) {
    script.diagnostics.push_back(
        finding(rules::StimulusArgument, rest[arguments.taken() + 1].span,
                fmt::format("`{}` takes {}", row->word, plural(arguments.taken(), "value"))));
    return;
  }
  script.events.push_back({at, stimulus});
}

StimulusScript parse_stimulus(const Source& source) {
  StimulusScript script;
  for (std::uint32_t line = 1; line <= source.line_count(); ++line)
    read_stimulus_line(source, line, script);
  sort_by_time(script.events);
  return script;
}

bool is_stimulus_line(std::string_view text) {
  return text.starts_with("at ") || text.starts_with("wall ");
}

void sort_by_time(std::vector<TimedStimulus>& script) {
  std::stable_sort(script.begin(), script.end(),
                   [](const auto& a, const auto& b) { return a.at < b.at; });
}

} // namespace orb::vm
