#pragma once

#include <map>
#include <string>

#include "welkin/map/chain.h"

namespace welkin {

/// As text metadata: `welkin.lobe`, `welkin.roughness` (`0,0.125,…`), `welkin.roughness-curve`,
/// `welkin.normalisation`, `welkin.software`, those that aren't empty.
std::map<std::string, std::string> attributes_of(const ChainNotes& notes);

/// The reverse. The roughness is left out when a number is malformed, not finite or negative, or when there
/// are more numbers than a chain can have levels. Never throws.
ChainNotes chain_notes_from(const std::map<std::string, std::string>& attributes);

}  // namespace welkin
