#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace orb {

/// The kind of value that fills a hole of a text.
enum class Hole : std::uint8_t {
  Code,   ///< source code, shown in backticks; never translated
  Number, ///< a whole number
  Name,   ///< names, figures and amounts, such as `90 ms`; never translated
  Part,   ///< another message
};

/// A text shown to users: a row of a table of texts (base/texts.inc).
struct Text {
  std::string_view english; ///< with a named hole, `{word}`, for each variable part
};

/// A message as data: a text with its fillers, or literal words. Only renderers turn it into a
/// sentence (in_english(), base/catalogue.h); no other code may read its words.
class Message {
public:
  /// An empty message.
  Message() = default;
  Message(const Text& text, std::vector<Message> fillers)
      : text_(&text), fillers_(std::move(fillers)) {}
  /// Literal words that are never translated: source, names, figures, output of another program.
  static Message as_is(std::string words) {
    Message message;
    message.words_ = std::move(words);
    return message;
  }

  bool empty() const { return text_ == nullptr && words_.empty(); }
  /// The row; null for literal words.
  const Text* text() const { return text_; }
  bool is(const Text& text) const { return text_ == &text; }
  /// The literal words; empty if there is a row.
  const std::string& words() const { return words_; }
  /// The fillers, in the order of the holes.
  const std::vector<Message>& fillers() const { return fillers_; }
  /// Replaces the filler of a hole.
  void refill(std::size_t hole, Message filler) { fillers_[hole] = std::move(filler); }

  friend bool operator==(const Message&, const Message&) = default;

private:
  const Text* text_ = nullptr;
  std::string words_;
  std::vector<Message> fillers_;
};

/// Renders the message in English.
std::string in_english(const Message& message);

/// Replaces each named hole of `text` by `hole(name)`.
template <typename Filler>
std::string with_holes_filled(std::string_view text, const Filler& hole) {
  std::string out;
  for (auto open = text.find('{'); open != std::string_view::npos; open = text.find('{')) {
    const auto close = std::min(text.find('}', open), text.size() - 1);
    out += text.substr(0, open);
    out += hole(text.substr(open + 1, close - open - 1));
    text.remove_prefix(close + 1);
  }
  return out.append(text);
}

/// The index of a hole: names count in the order of their first appearance.
constexpr std::size_t place_of_hole(std::string_view english, std::string_view name) {
  std::size_t place = 0;
  for (std::size_t open = english.find('{'); open != std::string_view::npos;
       open = english.find('{', open + 1)) {
    const auto here = english.substr(open + 1, english.find('}', open) - open - 1);
    if (here == name)
      return place;
    // Skip repeated names: they are already counted.
    if (english.find(english.substr(open, here.size() + 2)) == open)
      ++place;
  }
  return place;
}

/// Text that fills a hole: source or a name.
struct Words {
  Words(std::string_view given) : words(given) {}
  Words(std::string given) : words(std::move(given)) {}
  Words(const char* given) : words(given) {}
  Words(char given) : words(1, given) {}
  template <std::integral Number>
  Words(Number given) : words(std::to_string(given)) {}
  std::string words;
};

/// A whole number that fills a hole.
struct Figure {
  template <std::integral Number>
  Figure(Number given) : words(std::to_string(given)) {}
  std::string words;
};

/// A row of a table of texts: calling it with its fillers makes a message.
template <Hole... Kinds>
struct Row : Text {
  explicit consteval Row(std::string_view words) : Text{words} { check(words, {Kinds...}); }

  template <Hole Kind>
  using Argument = std::conditional_t<Kind == Hole::Part, Message,
                                      std::conditional_t<Kind == Hole::Number, Figure, Words>>;

  Message operator()(Argument<Kinds>... fillers) const {
    std::vector<Message> all;
    all.reserve(sizeof...(Kinds));
    (all.push_back(filler(std::move(fillers))), ...);
    return {*this, std::move(all)};
  }

private:
  static Message filler(Message message) { return message; }
  static Message filler(Words given) { return Message::as_is(std::move(given.words)); }
  static Message filler(Figure given) { return Message::as_is(std::move(given.words)); }

  /// Checks that code holes, and only they, are in backticks, and that each hole has a kind.
  static consteval void check(std::string_view words, std::initializer_list<Hole> kinds) {
    std::size_t holes = 0;
    for (auto open = words.find('{'); open != std::string_view::npos;
         open = words.find('{', open + 1)) {
      const auto name = words.substr(open, words.find('}', open) - open + 1);
      if (words.find(name) != open)
        continue;
      if (holes == kinds.size())
        throw "a hole has no kind";
      bool in_code = false;
      for (const auto c : words.substr(0, open))
        in_code = in_code != (c == '`');
      const auto kind = kinds.begin()[holes++];
      if (in_code ? kind != Hole::Code && kind != Hole::Number : kind == Hole::Code)
        throw "code is in backticks, and nothing else is";
    }
    if (holes != kinds.size())
      throw "a kind has no hole";
  }
};

} // namespace orb
