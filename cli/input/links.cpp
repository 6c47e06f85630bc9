#include "cli/input/links.h"

#include "base/bytes.h"
#include "base/text/text.h"
#include "base/text/utf8.h"
#include "disk/disk.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#define ZLIB_CONST // makes zlib's input pointers const
#include <zlib.h>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

// bytes; the page has the same limit (playground/page/workspace.js)
constexpr std::size_t most_bytes = 1024 * 1024;
constexpr std::size_t most_files = 24;
constexpr std::size_t longest_name = 60;
/// The packed program follows.
constexpr std::string_view mark = "#p=";

constexpr std::string_view alphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

/// base64url without padding.
Bytes decode_base64url(std::string_view text) {
  Bytes bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    bits = bits << 6 | static_cast<std::uint32_t>(alphabet.find(c));
    held += 6;
    if (held < 8)
      continue;
    held -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> held));
  }
  return bytes;
}

const std::string damaged = "is damaged: part of it is missing, or something was added";

/// Unpacks raw deflate data. The error is the end of a sentence.
tl::expected<std::string, std::string> inflate(const Bytes& packed) {
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK)
    return tl::unexpected(damaged);
  stream.next_in = packed.data();
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string text;
  std::array<char, 16384> piece{};
  int state = Z_OK;
  while (state == Z_OK && text.size() <= most_bytes) {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    state = ::inflate(&stream, Z_NO_FLUSH);
    text.append(piece.data(), piece.size() - stream.avail_out);
  }
  const bool whole = state == Z_STREAM_END && stream.avail_in == 0;
  inflateEnd(&stream);
  if (text.size() > most_bytes)
    return tl::unexpected(fmt::format("holds more than {} KiB", most_bytes >> 10));
  return whole ? tl::expected<std::string, std::string>(std::move(text)) : tl::unexpected(damaged);
}

bool is_file_name(std::string_view name) {
  const auto fits = [](char c) {
    return is_letter(c) || is_digit(c) || c == ' ' || c == '_' || c == '.' || c == '-';
  };
  return !name.empty() && name.size() <= longest_name &&
         (is_letter(name[0]) || is_digit(name[0])) && std::all_of(name.begin(), name.end(), fits);
}

/// Makes a name usable as one step of a path.
std::string step(std::string_view name) {
  auto made = to_printable(trim(name));
  std::replace_if(
      made.begin(), made.end(), [](char c) { return c == '/' || c == '\\'; }, '-');
  return made == "." || made == ".." ? std::string() : made;
}

std::string text_of(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Unpacks the part after the mark; sets only `trouble` if it cannot be read.
Shared read_packed(std::string_view packed) {
  const auto text = inflate(decode_base64url(packed));
  if (!text)
    return {.trouble = text.error()};
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.contains("files") || !json["files"].is_object())
    return {.trouble = damaged};
  Shared shared{.name = step(text_of(json, "name")), .main = text_of(json, "main")};
  for (const auto& [name, content] : json["files"].items())
    if (is_file_name(name) && content.is_string() && shared.files.size() < most_files)
      shared.files.emplace(name, content.get<std::string>());
  if (shared.files.empty())
    shared.trouble = "contains no files";
  return shared;
}

/// The words before the address in a line: a pupil's name in a class list.
std::string_view words_before(std::string_view line) {
  const auto address = line.rfind("://", line.find(mark));
  if (address == std::string_view::npos)
    return {};
  auto words = trim(line.substr(0, line.find_last_of(" \t,;<", address) + 1));
  while (!words.empty() && std::string_view(":,;-<\"").find(words.back()) != std::string_view::npos)
    words = trim(words.substr(0, words.size() - 1));
  return words;
}

tl::expected<std::string, Failure> read(const std::string& path) {
  if (const auto other = disk::what_else(path); !other.empty())
    return tl::unexpected(
        Failure{ExitCode::File, fmt::format("cannot read {}: it is {}", path, in_english(other))});
  auto text = disk::read(path);
  if (!text)
    return tl::unexpected(Failure{ExitCode::File, text.error().message});
  return *std::move(text);
}

/// Where the name of a file of addresses ends within `path`.
std::optional<std::size_t> end_of_link(const std::string& path) {
  for (auto end = path.find('/'); end != std::string::npos; end = path.find('/', end + 1)) {
    std::error_code absent;
    if (is_link_file(std::string_view(path).substr(0, end)) &&
        fs::is_regular_file(disk::as_path(path.substr(0, end)), absent))
      return end;
  }
  return std::nullopt;
}

} // namespace

bool is_link_file(std::string_view path) {
  return has_ending(path, link_ending);
}

tl::expected<std::vector<Shared>, std::string> read_links(std::string_view text) {
  std::vector<Shared> found;
  std::set<std::string> names;
  text.remove_prefix(byte_order_mark_size(text));
  while (!text.empty()) {
    const auto line = text.substr(0, text.find_first_of("\r\n"));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const auto at = line.find(mark);
    if (at == std::string_view::npos)
      continue;
    const auto rest = line.substr(at + mark.size());
    auto shared = read_packed(rest.substr(0, rest.find_first_not_of(alphabet)));
    if (shared.name.empty())
      shared.name = step(words_before(line));
    const auto number = fmt::format("{}", found.size() + 1);
    while (shared.name.empty() || !names.insert(shared.name).second)
      shared.name += (shared.name.empty() ? "" : " ") + number;
    found.push_back(std::move(shared));
  }
  if (found.empty())
    return tl::unexpected(fmt::format("it contains no playground address, `https://…{}…`", mark));
  return found;
}

tl::expected<std::vector<LinkFolder>, Failure> read_link_file(const std::string& path) {
  const auto text = read(path);
  if (!text)
    return tl::unexpected(text.error());
  auto shared = read_links(*text);
  if (!shared)
    return tl::unexpected(
        Failure{ExitCode::BadInput, fmt::format("cannot read {}: {}", path, shared.error())});
  std::vector<LinkFolder> folders;
  for (auto& one : *shared) {
    auto folder = shared->size() == 1 ? path : path + "/" + one.name;
    if (!one.trouble.empty())
      one.trouble = fmt::format("cannot read {}: the address {}", folder, one.trouble);
    folders.push_back({std::move(folder), std::move(one)});
  }
  return folders;
}

bool leads_through_link(const std::string& path) {
  return end_of_link(path).has_value();
}

tl::expected<std::string, Failure> Links::read(const std::string& path) {
  const auto file = path.substr(0, end_of_link(path).value_or(path.size()));
  auto at = known_.find(file);
  if (at == known_.end())
    at = known_.emplace(file, read_link_file(file)).first;
  if (!at->second)
    return tl::unexpected(at->second.error());
  for (const auto& [folder, shared] : *at->second) {
    if (!path.starts_with(folder + "/"))
      continue;
    if (!shared.trouble.empty())
      return tl::unexpected(Failure{ExitCode::BadInput, shared.trouble});
    if (const auto found = shared.files.find(path.substr(folder.size() + 1));
        found != shared.files.end())
      return found->second;
  }
  return tl::unexpected(Failure{
      ExitCode::File, fmt::format("cannot read {}: the address contains no such file", path)});
}

} // namespace orb::cli
