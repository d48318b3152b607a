#pragma once
// SHA-256: what tells one file, case or motion from another, and a whole file from a damaged one.

#include <filesystem>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace mpm
{
/// The digest of bytes that come piece by piece.
class Sha256
{
public:
  Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;
  ~Sha256();
  void add(std::string_view bytes);
  /// In lower-case hexadecimal, 64 characters; nothing can be added after it.
  std::string hexadecimal();

private:
  evp_md_ctx_st* context_;
};

/// SHA-256 in lower-case hexadecimal.
std::string sha256(std::string_view text);
/// `Error` input_missing when the file cannot be read.
std::string sha256_file(const std::filesystem::path&);
} // namespace mpm
