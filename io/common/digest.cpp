// SHA-256 (FIPS 180-4) of OpenSSL. It serves as a checksum against damage and to tell inputs apart, not
// against anybody who means harm.

#include "io/common/digest.hpp"

#include "io/common/error.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <vector>

namespace mpm
{
Sha256::Sha256() : context_(EVP_MD_CTX_new())
{
  EVP_DigestInit_ex(context_, EVP_sha256(), nullptr);
}

Sha256::~Sha256()
{
  EVP_MD_CTX_free(context_);
}

void Sha256::add(std::string_view bytes)
{
  EVP_DigestUpdate(context_, bytes.data(), bytes.size());
}

std::string Sha256::hexadecimal()
{
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned length = 0;
  EVP_DigestFinal_ex(context_, digest.data(), &length);
  return fmt::format("{:02x}", fmt::join(digest.begin(), digest.begin() + length, ""));
}

std::string sha256(std::string_view text)
{
  Sha256 digest;
  digest.add(text);
  return digest.hexadecimal();
}

std::string sha256_file(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  Sha256 digest;
  // In parts of 1 MB, so that a file of any size can be digested.
  std::vector<char> buffer(1 << 20);
  while (file.read(buffer.data(), std::streamsize(buffer.size())) || file.gcount() > 0)
    digest.add({buffer.data(), std::size_t(file.gcount())});
  // A file that cannot be opened ends here as well.
  if (!file.eof())
    throw Error(exit_code::input_missing,
                path.string() + ": cannot be read; check the path and its permissions");
  return digest.hexadecimal();
}
} // namespace mpm
