#include "cli/input/inputs.h"
#include "cli/terminal/watch.h"
#include "structured/text/read.h"

namespace orb::cli {
namespace {

/// Reads from disk and remembers the requested paths, existing or not.
class NotedFiles final : public structured::Files {
public:
  std::optional<std::string> read(const std::string& path) override {
    asked.push_back(path);
    return disk_.read(path);
  }
  Message obstacle(const std::string& path) override { return disk_.obstacle(path); }
  std::string identity(const std::string& path) override { return disk_.identity(path); }
  std::vector<std::string> asked;

private:
  DiskFiles disk_;
};

} // namespace

std::vector<std::string> files_of(const std::vector<std::string>& files, std::string_view lang) {
  auto all = files;
  for (const auto& file : files) {
    if (run::language_of(file, lang) != run::Language::Structured)
      continue;
    NotedFiles noted;
    if (const auto text = noted.read(file))
      structured::read(file, file, *text, noted);
    all.insert(all.end(), noted.asked.begin() + 1, noted.asked.end());
  }
  return all;
}

} // namespace orb::cli
