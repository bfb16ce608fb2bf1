#pragma once

#include <string>

namespace welkin::cli {

/// A message of the library, which knows no options, with the one that does what it proposes:
/// `…; another layer can be named (--layer): 'diffuse'`.
std::string with_option(std::string message);

}  // namespace welkin::cli
