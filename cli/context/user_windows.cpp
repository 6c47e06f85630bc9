#include "cli/context/user.h"

#include <array>
#include <cstdlib>
#include <string>
#include <windows.h>

#include <aclapi.h> // needs windows.h

namespace orb::cli {

namespace fs = std::filesystem;

namespace {

std::optional<fs::path> folder_in(const wchar_t* variable) {
  const wchar_t* value = ::_wgetenv(variable);
  return value != nullptr && *value != L'\0' ? std::optional<fs::path>(value) : std::nullopt;
}

bool is_of_this_user(PSID owner) {
  HANDLE token = nullptr;
  if (::OpenProcessToken(::GetCurrentProcess(), TOKEN_QUERY, &token) == 0)
    return false;
  alignas(TOKEN_USER) std::array<char, sizeof(TOKEN_USER) + SECURITY_MAX_SID_SIZE> user{};
  DWORD size = user.size();
  const bool known = ::GetTokenInformation(token, TokenUser, user.data(), size, &size) != 0;
  ::CloseHandle(token);
  return known && ::EqualSid(owner, reinterpret_cast<TOKEN_USER*>(user.data())->User.Sid) != 0;
}

} // namespace

std::optional<fs::path> user_home() {
  return folder_in(L"USERPROFILE");
}

std::optional<fs::path> user_file() {
  if (const auto xdg = folder_in(L"XDG_CONFIG_HOME"))
    return *xdg / "orb" / "config.toml";
  if (const auto data = folder_in(L"APPDATA"))
    return *data / "orb" / "config.toml";
  return std::nullopt;
}

bool is_trusted(const fs::path& path) {
  PSID owner = nullptr;
  PSECURITY_DESCRIPTOR all = nullptr;
  if (::GetNamedSecurityInfoW(path.c_str(), SE_FILE_OBJECT, OWNER_SECURITY_INFORMATION, &owner,
                              nullptr, nullptr, nullptr, &all) != ERROR_SUCCESS)
    return false;
  const bool trusted = is_of_this_user(owner) ||
                       ::IsWellKnownSid(owner, WinBuiltinAdministratorsSid) != 0 ||
                       ::IsWellKnownSid(owner, WinLocalSystemSid) != 0;
  ::LocalFree(all);
  return trusted;
}

} // namespace orb::cli
