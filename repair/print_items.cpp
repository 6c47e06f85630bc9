#include "repair/print_items.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace orb::repair {
namespace {

/// Converts text with `{name}` into items of `print`.
std::string parts_of(std::string_view text, std::string_view open, std::string_view close) {
  std::string items;
  while (!text.empty()) {
    const auto begin = text.find(open);
    const auto end = begin == std::string_view::npos ? begin : text.find(close, begin);
    const auto said = text.substr(0, end == std::string_view::npos ? end : begin);
    if (!said.empty())
      items += fmt::format("{}\"{}\"", items.empty() ? "" : " ", said);
    if (end == std::string_view::npos)
      break;
    items += fmt::format("{}{}", items.empty() ? "" : " ",
                         text.substr(begin + open.size(), end - begin - open.size()));
    text.remove_prefix(end + close.size());
  }
  return items.empty() ? "\"\"" : items;
}

/// Converts a format with its values: `"%d left\n", n`.
std::optional<std::string> formatted(const Tokens& tokens) {
  auto text = tokens[0].text;
  while (text.ends_with("\\n"))
    text.resize(text.size() - 2);
  std::vector<Tokens> values;
  for (std::size_t i = 1; i < tokens.size(); ++i)
    if (tokens[i].is(",") || tokens[i].is("%"))
      values.emplace_back();
    else if (!values.empty())
      values.back().push_back(tokens[i]);
  std::string items;
  std::size_t next = 0;
  std::string said;
  const auto flush = [&] {
    if (!said.empty())
      items += fmt::format("{}\"{}\"", items.empty() ? "" : " ", said);
    said.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto mark = std::string_view(text).substr(i);
    const auto width = mark.starts_with("%d") || mark.starts_with("%i") || mark.starts_with("{}") ||
                               mark.starts_with("%s") || mark.starts_with("%u")
                           ? 2U
                       : mark.starts_with("%ld") ? 3U
                                                 : 0U;
    if (width == 0) {
      said += text[i];
      continue;
    }
    if (next == values.size())
      return std::nullopt;
    flush();
    items += fmt::format("{}{}", items.empty() ? "" : " ", join(values[next++]));
    i += width - 1;
  }
  flush();
  return next == values.size() && !items.empty() ? std::optional(items) : std::nullopt;
}

} // namespace

std::optional<std::string> print_items(const Tokens& tokens) {
  if (tokens.empty())
    return std::nullopt;
  if (tokens[0].is_text() && tokens[0].text.find('%') != std::string::npos && tokens.size() > 1)
    if (auto text = formatted(tokens))
      return text;
  if (tokens.size() == 1 && tokens[0].is_text() && tokens[0].text.ends_with("\\n"))
    return formatted(tokens);
  std::string out;
  int depth = 0;
  bool apart = true;
  const bool has_text =
      std::any_of(tokens.begin(), tokens.end(), [](const Token& token) { return token.is_text(); });
  bool said = false; // seen a text: from here on `+` joins texts
  const auto beside_text = [&](std::size_t i) {
    return (i > 0 && tokens[i - 1].is_text()) ||
           (i + 1 < tokens.size() && tokens[i + 1].is_text()) ||
           (i + 1 < tokens.size() && (tokens[i + 1].is("str") || tokens[i + 1].is("String"))) ||
           (i > 0 && tokens[i - 1].is(")") && out.ends_with("\x01"));
  };
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const auto& token = tokens[i];
    const bool converts = token.is("str") || token.is("String") || token.is("STR") ||
                          token.is("string") || token.is("buildString");
    if (converts && i + 1 < tokens.size() && tokens[i + 1].is("(")) {
      Tokens inner;
      int open = 0;
      for (++i; i < tokens.size(); ++i) {
        open += tokens[i].is("(") ? 1 : tokens[i].is(")") ? -1 : 0;
        if (open == 0)
          break;
        if (!(open == 1 && inner.empty() && tokens[i].is("(")))
          inner.push_back(tokens[i]);
      }
      out += (apart ? "" : " ") + join(inner) + "\x01";
      apart = false;
      continue;
    }
    const bool joins =
        token.is("+") || token.is("&") || token.is("<<") || token.is(".") || token.is("..");
    if (depth == 0 && (token.is(";") || (joins && (said || beside_text(i))))) {
      if (token.is(";") && i + 1 == tokens.size())
        out += ";";
      apart = false;
      continue;
    }
    if ((token.is("f") || token.is("$")) && i + 1 < tokens.size() && tokens[i + 1].is_text() &&
        !tokens[i + 1].gap) {
      out += (apart ? "" : " ") + parts_of(tokens[++i].text, "{", "}");
      apart = false;
      continue;
    }
    if (token.is_text() && token.text.find("${") != std::string::npos) {
      out += (apart ? "" : " ") + parts_of(token.text, "${", "}");
      apart = false;
      continue;
    }
    if (depth == 0 && token.is("and") && has_text) {
      out += ',';
      continue;
    }
    depth += token.is("(") ? 1 : token.is(")") ? -1 : 0;
    said = depth == 0 && (token.is_text() || (said && !token.is(",")));
    const bool wants_gap = !apart && !token.is(",") &&
                           (token.gap || i == 0 || token.is_text() || tokens[i - 1].is_text() ||
                            out.ends_with("\x01") || tokens[i - 1].is("+"));
    out += (wants_gap ? " " : "") + (token.is_text() ? '"' + token.text + '"' : token.text);
    apart = false;
  }
  out.erase(std::remove(out.begin(), out.end(), '\x01'), out.end());
  while (!out.empty() && out.front() == ' ')
    out.erase(out.begin());
  return out.empty() ? std::nullopt : std::optional(out);
}

std::optional<std::string> quoted(const Tokens& tokens) {
  std::string text;
  constexpr std::string_view plain = ".!?:,()-/&";
  const auto is_value = [](const Token& token) { // `A` and `x`; `a` and `I` are also words
    return token.is_word() && token.text.size() == 1 && !token.is("a") && !token.is("I");
  };
  if (std::any_of(tokens.begin(), tokens.end(), is_value) ||
      std::none_of(tokens.begin(), tokens.end(),
                   [](const Token& token) { return token.text.size() > 1; }))
    return std::nullopt;
  for (const auto& token : tokens) {
    if (!token.is_word() &&
        (text.empty() || !(token.is_number() || plain.find(token.text) != std::string_view::npos)))
      return std::nullopt;
    text += (token.gap && !text.empty() ? " " : "") + token.text;
  }
  return text.size() < 3 ? std::nullopt : std::optional(fmt::format("\"{}\"", text));
}

} // namespace orb::repair
