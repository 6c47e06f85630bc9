#include "playground/engine/request.h"

#include "base/bytes.h"
#include "playground/engine/sources.h"
#include "testing/suite.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <utility>

namespace orb::playground {
namespace {

constexpr auto hex_member = "hex"; // a Uint8Array in JSON

std::string_view without_root(std::string_view path) {
  while (path.starts_with('/') || path.starts_with("./"))
    path.remove_prefix(path.front() == '/' ? 1 : 2);
  return path;
}

std::string content(const ordered_json& file) {
  if (file.is_string())
    return file.get<std::string>();
  return std::string(as_text(bytes_of(file)));
}

} // namespace

tl::unexpected<Problem> refuse(const Failure& failure) {
  return refuse(failure.code, failure.message);
}

tl::unexpected<Problem> refuse(ExitCode code, std::string message) {
  return tl::unexpected(Problem{code, std::move(message)});
}

MemoryFiles::MemoryFiles(const ordered_json& params) {
  const auto files = params.find("files");
  if (files == params.end())
    return;
  for (const auto& [name, file] : files->items()) {
    if (texts_.empty())
      first_ = without_root(name);
    texts_.insert_or_assign(std::string(without_root(name)), content(file));
  }
}

std::optional<std::string> MemoryFiles::read(const std::string& path) {
  const auto found = texts_.find(without_root(path));
  return found == texts_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string> MemoryFiles::sources(const std::string&) {
  std::vector<std::string> found;
  for (const auto& [name, text] : texts_)
    if (run::language_of(name, "") || testing::is_test(name))
      found.push_back("/" + name);
  return found;
}

Request::Request(const ordered_json& given, SentenceLog& kept)
    : params(given), said(kept), files(given), names(texts("names")) {
  if (names.empty() && !files.first().empty())
    names = {files.first()};
}

std::string Request::text(const char* key, std::string_view otherwise) const {
  return value<std::string>(key).value_or(std::string(otherwise));
}

bool Request::flag(const char* key, bool otherwise) const {
  return value<bool>(key).value_or(otherwise);
}

std::vector<std::string> Request::texts(const char* key) const {
  const auto found = params.find(key);
  if (found == params.end() || found->is_null())
    return {};
  if (found->is_string())
    return {found->get<std::string>()};
  return found->get<std::vector<std::string>>();
}

tl::expected<std::string, Problem> Request::read(const std::string& name) {
  auto text = files.read(name);
  if (!text)
    return refuse(ExitCode::File, fmt::format("there is no file {}", name));
  return *std::move(text);
}

tl::expected<std::vector<run::SourceFile>, Problem> Request::sources() {
  std::vector<run::SourceFile> all;
  for (const auto& name : names) {
    auto text = read(name);
    if (!text)
      return tl::unexpected(text.error());
    const auto language = run::language_of(name, "");
    if (!language && !testing::is_no_program(name))
      return refuse(run::unknown_content(name));
    all.push_back({name, language, Source(name, *std::move(text))});
  }
  return all;
}

tl::expected<std::vector<run::Input>, Problem> Request::inputs() {
  std::vector<run::Input> inputs;
  for (const auto& name : names) {
    auto text = read(name);
    if (!text)
      return tl::unexpected(text.error());
    auto input = run::read_input(name, *std::move(text), "", {}, files);
    if (!input)
      return refuse(input.error());
    if (input->has_errors())
      return tl::unexpected(Problem{ExitCode::BadInput, fmt::format("{} has errors", name),
                                    check(*this).value_or("")});
    run::add_input(inputs, *std::move(input));
  }
  return inputs;
}

std::string print(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

ordered_json bytes_json(ByteView bytes) {
  return {{hex_member, to_hex(bytes)}};
}

Bytes bytes_of(const ordered_json& json) {
  return from_hex(json.at(hex_member).get<std::string>()).value_or(Bytes{});
}

double milliseconds(Duration t) {
  return std::chrono::duration<double, std::milli>(t).count();
}

Duration duration_of(double milliseconds) {
  return std::chrono::duration_cast<Duration>(
      std::chrono::duration<double, std::milli>(milliseconds));
}

} // namespace orb::playground
