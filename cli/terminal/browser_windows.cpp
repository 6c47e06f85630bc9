#include "cli/terminal/browser.h"

#include "disk/disk.h"

#include <filesystem>
#include <fmt/format.h>
#include <windows.h>

#include <shellapi.h> // needs windows.h

namespace orb::cli {

tl::expected<void, std::string> show_in_browser(const std::string& path) {
  std::error_code ignored;
  const auto file = std::filesystem::absolute(disk::as_path(path), ignored).make_preferred();
  constexpr INT_PTR least_success = 32;
  const auto result =
      ::ShellExecuteW(nullptr, L"open", file.c_str(), nullptr, nullptr, SW_SHOWNORMAL);
  if (reinterpret_cast<INT_PTR>(result) > least_success)
    return {};
  return tl::unexpected(fmt::format("no browser could be started; the report is in {}", path));
}

} // namespace orb::cli
