#pragma once

#include "welkin/lobe/blinn.h"
#include "welkin/lobe/charlie.h"
#include "welkin/lobe/ggx.h"
#include "welkin/lobe/lambert.h"
#include "welkin/lobe/phong.h"
#include "welkin/lobe/table.h"
#include "welkin/lobe/von_mises_fisher.h"

namespace welkin::lobe {

template <class... L>
struct TypeList {};

/// Every lobe that Welkin knows. To add one, write its header and name it here. A lobe is a default
/// constructible struct with
///
///     kName, kDescription, kSource   text: its name in specs, what it is for, author and year
///     weight<T>(s)                   w(s), for double, float and packs; s from 0 to 2; finite, not negative
///     mirror(), width(), breakpoints()   as AnyLobe has them
///     visit_parameters(visit)        if it has any: calls visit(name, value, minimum, maximum, description),
///                                    `value` a double&, for each
///     visit_synonyms(visit)          if it has any: the same for other numbers that stand for a parameter
using AllLobes = TypeList<Lambert, Phong, Blinn, Ggx, Charlie, VonMisesFisher, Table>;

}  // namespace welkin::lobe
