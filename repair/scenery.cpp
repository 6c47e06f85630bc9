#include "repair/scenery.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/arrange.h"

#include <algorithm>
#include <iterator>

namespace orb::repair {
namespace {

std::string digits_of(std::string_view head) {
  std::string digits;
  std::copy_if(head.begin(), head.end(), std::back_inserter(digits), is_digit);
  return digits;
}

} // namespace

std::size_t values_between(const Tokens& line, std::size_t open) {
  if (open + 2 >= line.size() || !line[open].is("("))
    return 0;
  std::size_t values = 1;
  int depth = 0;
  for (auto i = open; i < line.size(); ++i) {
    depth += line[i].is("(") ? 1 : line[i].is(")") ? -1 : 0;
    if (depth == 0)
      return i == open + 1 ? 0 : values;
    values += depth == 1 && line[i].is(",") ? 1 : 0;
  }
  return values;
}

std::string Scenery::sub_like(std::string_view word) const {
  const auto like = std::find_if(subs_.begin(), subs_.end(),
                                 [&](const Sub& sub) { return mean_the_same(sub.name, word); });
  return like == subs_.end() ? std::string() : like->name;
}

const Scenery::Sub* Scenery::only_sub(const std::function<bool(const Sub&)>& fits) const {
  const auto one = std::find_if(subs_.begin(), subs_.end(), fits);
  return one != subs_.end() && std::find_if(one + 1, subs_.end(), fits) == subs_.end() ? &*one
                                                                                       : nullptr;
}

const Scenery::Sub* Scenery::uncalled() const {
  return only_sub([this](const Sub& sub) { return words_.at(sub.name) == 1; });
}

std::string Scenery::sub_for(std::string_view word, std::size_t values) const {
  const auto uses = words_.find(std::string(word));
  const auto* const sub = uncalled();
  const bool fits =
      uses != words_.end() && uses->second > 1 && sub != nullptr && sub->takes == values;
  return fits ? sub->name : std::string();
}

std::string Scenery::sub_meant(std::size_t values) const {
  const auto* sub = uncalled();
  if (sub == nullptr)
    sub = only_sub([&](const Sub& one) { return one.takes == values; });
  return sub == nullptr ? std::string() : sub->name;
}

Scenery::Scenery(const Source& source, Language language) : source_(source), language_(language) {
  for (std::uint32_t n = 1; n <= source.line_count(); ++n) {
    closers_.push_back(open_.empty() ? "" : open_.back());
    in_function_.push_back(std::find(open_.begin(), open_.end(), "end function") != open_.end());
    loops_.push_back(counting_.empty() ? "" : counting_.back());
    const auto line = source.line(n);
    const auto tokens = split(line.substr(0, longest_line), language).tokens;
    note_jumps(n, tokens);
    if (line.size() > longest_line)
      continue;
    if (!tokens.empty() && (language == Language::Structured || language == Language::Macro))
      open_or_close(tokens);
    if (tokens.size() > 1 && equal_words(tokens[0].text, "for"))
      counting_.push_back(tokens[1].text);
    else if (!tokens.empty() && equal_words(tokens[0].text, "next") && !counting_.empty())
      counting_.pop_back();
    note_roll(n, tokens);
    if (language == Language::Structured && tokens.size() == 2 && tokens[0].is_word() &&
        tokens[1].is(":") && !equal_words(tokens[0].text, "else"))
      labels_.push_back(tokens[0].text);
    if (language == Language::Structured && tokens.size() > 1 && tokens[1].is_word())
      if (const auto first = word_at(tokens, 0); first == "sub" || first == "function")
        subs_.push_back({tokens[1].text, values_between(tokens, 2)});
    if (tokens.size() > 1 && tokens[0].is("array") && tokens[1].is_word())
      arrays_.insert(lower(tokens[1].text));
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (!tokens[i].is_word())
        continue;
      ++words_[tokens[i].text];
      if (i + 1 < tokens.size() && tokens[i + 1].is("=") && tokens[i].text.size() > 1)
        ++set_[tokens[i].text];
    }
  }
}

bool Scenery::is_array(std::string_view word) const {
  return arrays_.contains(lower(word));
}

bool Scenery::is_sub(std::string_view word) const {
  return std::any_of(subs_.begin(), subs_.end(),
                     [&](const Sub& one) { return equal_words(one.name, word); });
}

std::string Scenery::sub_of(const Tokens& line) const {
  if (subs_.empty())
    return {};
  std::string words;
  for (const auto& token : line)
    words += (words.empty() ? "" : "_") + token.text;
  if (line.size() > 1 && is_sub(words))
    return words;
  for (std::size_t i = 0; i < std::min<std::size_t>(line.size(), 2); ++i)
    if (line[i].is_word() && is_sub(line[i].text))
      return line[i].text;
  return {};
}

std::vector<std::string_view> Scenery::words_without(const Tokens& line) const {
  std::vector<std::string_view> names;
  for (const auto& [word, count] : words_) {
    const auto here = std::count_if(line.begin(), line.end(), [&word = word](const Token& token) {
      return token.text == word;
    });
    if (count > static_cast<std::size_t>(here) && word.size() != 1)
      names.push_back(word);
  }
  return names;
}

std::vector<std::string_view> Scenery::set_without(const Tokens& line) const {
  std::vector<std::string_view> names;
  for (const auto& [word, count] : set_) {
    std::size_t here = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      here += line[i].text == word && line[i + 1].is("=") ? 1 : 0;
    if (count > here)
      names.push_back(word);
  }
  return names;
}

std::optional<std::string> Scenery::misspelt(std::string_view word,
                                             const std::vector<std::string_view>& known) const {
  const auto uses = words_.find(std::string(word));
  if (uses == words_.end() || uses->second < 2)
    return std::nullopt;
  for (const auto& [other, count] : words_)
    if (count == 1 && other.size() > 2 &&
        (edit_distance(other, word) * 3 <= std::max(other.size(), word.size()) ||
         mean_the_same(other, word)) &&
        std::none_of(known.begin(), known.end(),
                     [&one = other](std::string_view k) { return equal_words(k, one); }))
      return other;
  return std::nullopt;
}

std::string Scenery::number_of(std::string_view name) const {
  for (std::uint32_t n = 1; n <= source_.line_count(); ++n) {
    const auto line = source_.line(n).substr(0, longest_line);
    const auto parts = split(line, language_);
    auto rest = line.substr(parts.head.size());
    rest.remove_prefix(std::min(rest.find_first_not_of("' \t"), rest.size()));
    if (rest.size() > name.size() && equal_words(rest.substr(0, name.size()), name) &&
        rest[name.size()] == ':') {
      // A label alone on its line belongs to the line below, which stays if the label is removed.
      rest.remove_prefix(name.size() + 1);
      const bool alone = parts.tokens.empty() || rest.find_first_not_of(" \t'") == rest.npos;
      const auto below = alone ? number_below(n) : std::string();
      return below.empty() ? digits_of(parts.head) : below;
    }
  }
  return {};
}

std::string Scenery::number(std::uint32_t line) const {
  return digits_of(split(source_.line(line).substr(0, longest_line), language_).head);
}

std::string Scenery::number_below(std::uint32_t line) const {
  while (++line <= source_.line_count()) {
    const auto parts = split(source_.line(line).substr(0, longest_line), language_);
    if (auto digits = digits_of(parts.head); !digits.empty() && !parts.tokens.empty())
      return digits;
  }
  return {};
}

std::string Scenery::number_above(std::uint32_t line) const {
  while (--line > 0)
    if (auto digits = number(line); !digits.empty())
      return digits;
  return {};
}

void Scenery::note_jumps(std::uint32_t line, const Tokens& tokens) {
  bool jumps = false; // a number here is a line number
  bool calls = false;
  for (const auto& token : tokens) {
    const bool begins = token.is("goto") || token.is("gosub");
    jumps = begins || (jumps && (token.is_number() || token.is(",")));
    calls = begins ? token.is("gosub") : calls;
    if (jumps && token.is_number())
      jumps_.push_back({token.text, source_.line_start(line) + token.at, calls});
  }
}

std::vector<Span> Scenery::jumps_to(std::string_view number) const {
  std::vector<Span> found;
  for (const auto& jump : jumps_)
    if (jump.to == number)
      found.push_back({jump.begin, jump.begin + static_cast<std::uint32_t>(jump.to.size())});
  return found;
}

bool Scenery::ends_sub(std::uint32_t line) const {
  const auto is_called = [&](std::string_view number) {
    return std::any_of(jumps_.begin(), jumps_.end(),
                       [&](const Jump& jump) { return jump.calls && jump.to == number; });
  };
  const auto below = number_below(line);
  if (!below.empty() && !is_called(below))
    return false;
  for (auto n = line; !is_called(number(n)); --n) {
    const auto above =
        n == 1 ? Tokens() : split(source_.line(n - 1).substr(0, longest_line), language_).tokens;
    if (n == 1 || (!above.empty() && holds("return end goto", above[0].text)))
      return false;
  }
  return true;
}

Surroundings Scenery::around(std::uint32_t line, const SplitLine& parts) const {
  Surroundings all;
  all.language = language_;
  all.line_number = digits_of(parts.head);
  all.loop = loops_[line - 1];
  const auto below = std::partition_point(rolls_.begin(), rolls_.end(),
                                          [&](const Roll& roll) { return roll.line < line; });
  if (below != rolls_.begin()) {
    all.heading = std::prev(below)->heading;
    all.steering = std::prev(below)->steering;
    all.pace = std::prev(below)->pace;
  }
  if (language_ == Language::Basic) {
    const auto free = free_letters();
    all.free_letter = free.empty() ? "" : free.front();
    const auto first = number_below(0);
    all.first_number = first == all.line_number ? "" : first;
    all.number_below = number_below(line);
    all.ends_sub = ends_sub(line);
  } else if (language_ == Language::Structured || language_ == Language::Macro) {
    all.closer = closers_[line - 1];
    all.in_function = in_function_[line - 1];
    all.label = labels_.size() == 1 ? labels_.front() : "";
  }
  return all;
}

void Scenery::note_roll(std::uint32_t line, Tokens tokens) {
  const bool macro = language_ == Language::Macro;
  const bool steers = tokens.size() > 2 && tokens[1].is_word() && tokens[2].is(",");
  std::erase_if(tokens, [](const Token& token) { return token.is(","); });
  if (tokens.size() < 3 || !tokens[0].is(macro ? "roll" : "goroll"))
    return;
  const auto& heading = tokens[macro ? 2 : 1];
  const auto& pace = tokens[macro ? 1 : 2];
  const bool rests =
      pace.text == "0" || pace.kind == Token::Kind::Sign || (!macro && tokens.back().is("0"));
  rolls_.push_back({line, parse_number<int>(heading.text).value_or(0), steers ? heading.text : "",
                    rests ? "" : pace.text});
}

std::vector<std::string> Scenery::free_letters() const {
  // A `next` below without a `for` names the variable.
  std::multiset<std::string> open;
  for (std::uint32_t n = source_.line_count(); n > 0; --n) {
    const auto tokens = split(source_.line(n).substr(0, longest_line), language_).tokens;
    if (tokens.size() < 2 || tokens[1].text.size() != 1)
      continue;
    if (equal_words(tokens[0].text, "next"))
      open.insert(tokens[1].text);
    else if (const auto one = open.find(tokens[1].text);
             equal_words(tokens[0].text, "for") && one != open.end())
      open.erase(one);
  }
  std::vector<std::string> free(open.begin(), open.end());
  for (const char c : std::string_view("IJKNCDEFGHLMOPQRSTUVWXAB")) {
    const std::string upper(1, c);
    if (words_.count(upper) == 0 && words_.count(std::string(1, to_lower(c))) == 0)
      free.push_back(upper);
  }
  return free;
}

void Scenery::open_or_close(const Tokens& line) {
  const auto first = word_at(line, 0);
  const auto is = [&](std::string_view word) { return first == word; };
  if (language_ == Language::Macro && (is("loop_start") || is("loop_end"))) {
    open_.clear(); // they do not nest
    if (is("loop_start"))
      open_.emplace_back("loop_end");
  } else if (language_ == Language::Macro) {
    if (is("loop") || is("repeat") || is("for"))
      open_.emplace_back("loop_end");
  } else if (is("while") || is("loop") || is("repeat") || is("select") || is("sub") ||
             is("function") || is("for"))
    open_.push_back(is("for") ? "next" : "end " + first);
  else if (is("def") || is("void"))
    open_.emplace_back(line.size() < 2 || line[1].is("loop")       ? "end loop"
                       : line[1].is("setup") || line[1].is("main") ? "-"
                                                                   : "end sub");
  else if (is("switch") || is("match"))
    open_.emplace_back("end select");
  else if (is("forever") || is("do"))
    open_.emplace_back("end loop");
  else if (is("if") &&
           (word_at(line, line.size() - 1) == "then" || line.back().is("{") || line.back().is(":")))
    open_.emplace_back("end if");
  else if (((is("end") && line.size() > 1) || first.starts_with("end ") || is("next") ||
            is("until") || is("}") || is("wend") || is("endif")) &&
           !open_.empty() && !(line.size() > 1 && line[1].is("else")))
    open_.pop_back();
}

} // namespace orb::repair
