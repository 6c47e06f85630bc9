#include "protocol/log_text.h"

#include "base/text/text.h"
#include "base/text/utf8.h"

#include <algorithm>
#include <array>

namespace orb::protocol {
namespace {

constexpr std::string_view parting = " \t,;[](){}\"'|";
constexpr std::string_view parting_in_front = " \t;[](){}\"'|"; // `12:00:01,234` is one word
/// A run of this many bytes is data, whatever surrounds it.
constexpr std::size_t surely_bytes = 4;
/// `12:00:01` is a time of day, `68:86:E7:00:11:22` a robot's address.
constexpr std::size_t joined_least = 7;
constexpr std::size_t digits_of_byte = 2;

// Words by which logs tell the direction; the first in a line counts.
constexpr std::string_view to_ball =
    "> >> -> --> => \u2192 tx send sent sending write wrote writing request out to command host "
    "client";
constexpr std::string_view from_ball =
    "< << <- <-- <= \u2190 rx recv receive received receiving read reading notify notification "
    "response answer in from ball robot";

std::vector<std::string_view> words_of(std::string_view text, std::string_view between) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(between, at)) != std::string_view::npos;) {
    const auto end = std::min(text.find_first_of(between, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

/// Converts a word to bytes: `FF`, `ffff0001`, `0xa`, `0x8d0a`, `8d:0a:13:0d:00:d5`.
std::optional<Bytes> bytes_of(std::string_view word) {
  const bool marked = word.starts_with("0x") || word.starts_with("0X");
  if (marked && word.size() == digits_of_byte + 1) // one digit
    if (const auto digit = parse_number<std::uint8_t>(word.substr(digits_of_byte), 16))
      return Bytes{*digit};
  for (const char joint : {':', '-'})
    if (word.find(joint) != std::string_view::npos) {
      Bytes joined;
      const auto pairs = words_of(word, std::string_view(&joint, 1));
      for (const auto pair : pairs) {
        const auto byte = pair.size() == digits_of_byte ? from_hex(pair) : std::nullopt;
        if (!byte || byte->empty())
          return std::nullopt;
        joined.push_back(byte->front());
      }
      const bool is_packet = !joined.empty() && joined.front() == spec::sop1;
      return is_packet || joined.size() >= joined_least ? std::optional(joined) : std::nullopt;
    }
  auto bytes = from_hex(word);
  return bytes && !bytes->empty() ? bytes : std::nullopt;
}

/// Bytes found in a line, and their place.
struct Run {
  std::size_t begin = 0;
  std::size_t end = 0;
  Bytes bytes;
};

/// Returns the longest run of bytes; of two, the later.
std::optional<Run> longest_run(std::string_view line) {
  std::optional<Run> best, run;
  for (const auto word : words_of(line, parting)) {
    const auto at = static_cast<std::size_t>(word.data() - line.data());
    const auto bytes = bytes_of(word);
    if (!bytes) {
      run.reset();
      continue;
    }
    if (!run)
      run.emplace().begin = at;
    run->end = at + word.size();
    run->bytes.insert(run->bytes.end(), bytes->begin(), bytes->end());
    if (!best || run->bytes.size() >= best->bytes.size())
      best = run;
  }
  return best;
}

/// Parses `\x8d`, `\n`, `\\` or a plain character at the front of `text`, and sets `size` to its
/// length. nullopt if it is not a byte.
std::optional<std::uint8_t> python_byte(std::string_view text, std::size_t& size) {
  size = 1;
  if (text.front() != '\\')
    return static_cast<std::uint8_t>(text.front());
  if (text.size() < digits_of_byte)
    return std::nullopt;
  size = 2;
  constexpr std::string_view names = R"(abfnrtv\'"0)";
  constexpr std::string_view means{"\a\b\f\n\r\t\v\\'\"\0", names.size()};
  if (text[1] == 'x') {
    size = 4; // backslash, x, two digits
    const auto byte = text.size() < size ? std::nullopt : from_hex(text.substr(2, digits_of_byte));
    return byte && byte->size() == 1 ? std::optional(byte->front()) : std::nullopt;
  }
  const auto at = names.find(text[1]);
  return at == std::string_view::npos ? std::nullopt
                                      : std::optional(static_cast<std::uint8_t>(means[at]));
}

/// Parses `bytearray(b'\x8d\n')`.
std::optional<Run> python_run(std::string_view line) {
  for (const std::string_view opening : {"b'", "b\""}) {
    const auto begin = line.find(opening);
    if (begin == std::string_view::npos || (begin > 0 && is_letter(line[begin - 1])))
      continue;
    Run run{begin, begin + opening.size(), {}};
    while (run.end < line.size() && line[run.end] != opening.back()) {
      std::size_t size = 0;
      const auto byte = python_byte(line.substr(run.end), size);
      if (!byte)
        return std::nullopt;
      run.bytes.push_back(*byte);
      run.end += size;
    }
    if (run.end < line.size() && !run.bytes.empty())
      return run;
  }
  return std::nullopt;
}

bool is_time(std::string_view word) {
  constexpr std::string_view parts = "0123456789:.,-+/TZs";
  return is_digit(word.front()) && word.find_first_not_of(parts) == std::string_view::npos;
}

bool is_number(std::string_view word) {
  return std::all_of(word.begin(), word.end(), is_digit);
}

/// The text before the bytes.
struct Front {
  std::string when;
  std::optional<Direction> direction;
  bool says_more = false;
};

Front read_front(std::string_view text) {
  Front front;
  for (auto word : words_of(text, parting_in_front)) {
    while (word.ends_with(':') || word.ends_with(','))
      word.remove_suffix(1);
    if (word.empty())
      continue;
    const bool is_first = front.when.empty() && !front.direction && !front.says_more;
    if (is_time(word) && (is_first || !is_number(word))) {
      front.when += (front.when.empty() ? "" : " ") + std::string(word);
      continue;
    }
    for (const auto part : words_of(word, ":")) {
      const bool out = holds(to_ball, part);
      if (!out && !holds(from_ball, part))
        front.says_more = true;
      else if (!front.direction)
        front.direction = out ? Direction::ToBall : Direction::FromBall;
    }
  }
  return front;
}

/// Adds up hours, minutes and seconds separated by `:`.
std::optional<double> seconds_of(std::string_view clock) {
  constexpr double sixty = 60;
  double seconds = 0;
  std::string part;
  const auto add = [&] {
    const auto value = parse_real(part, std::chars_format::fixed);
    seconds = seconds * sixty + value.value_or(0);
    part.clear();
    return value && *value >= 0;
  };
  for (const char c : clock)
    if (c == ':') {
      if (!add())
        return std::nullopt;
    } else {
      part += c == ',' ? '.' : c;
    }
  return add() ? std::optional(seconds) : std::nullopt;
}

/// Parses a time of day, or a time since any moment: `0.123`, `12:00:01,5`. Skips a date before it.
std::optional<Duration> moment(std::string_view when) {
  const auto date = when.find_last_of(" T");
  auto clock = date == std::string_view::npos ? when : when.substr(date + 1);
  clock = clock.substr(0, clock.find_first_of("Z+s"));
  const auto seconds = seconds_of(clock);
  constexpr double too_long = 4e9; // beyond today's Unix time it is a number, not a time
  if (!seconds || *seconds > too_long)
    return std::nullopt;
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(*seconds));
}

std::optional<LogLine> read_line(std::string_view line) {
  auto run = python_run(line);
  if (!run)
    run = longest_run(line);
  if (!run)
    return std::nullopt;
  auto front = read_front(line.substr(0, run->begin));
  const bool stands_alone = front.direction && !front.says_more &&
                            line.find_first_not_of(parting, run->end) == std::string_view::npos;
  if (run->bytes.size() < surely_bytes && !stands_alone)
    return std::nullopt;
  const auto at = moment(front.when);
  const bool greets = spec::is_greeting(as_text(run->bytes));
  return LogLine{std::move(front.when), front.direction, std::move(run->bytes), at, 0, greets};
}

} // namespace

LogText read_log(std::string_view text) {
  LogText log;
  text.remove_prefix(byte_order_mark_size(text));
  for (std::size_t number = 1; !text.empty(); ++number) {
    const auto end = std::min(text.find('\n'), text.size());
    auto line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (line.ends_with('\r'))
      line.remove_suffix(1);
    line = trim(line);
    if (line.empty() || line.front() == '#')
      continue;
    ++log.read_lines;
    if (auto read = read_line(line)) {
      read->number = number;
      log.lines.push_back(*std::move(read));
    } else if (log.strangers++ == 0) {
      log.first_stranger = number;
      log.stranger = line;
    }
  }
  return log;
}

} // namespace orb::protocol
