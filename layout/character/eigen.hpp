// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

/// Eigen, for the headers of the component `characters` and of `import`, which stands on it.

#if !__has_include(<Eigen/Geometry>)
#error "Eigen is missing: name bch's component characters (or import) in find_package(), and link it."
#endif

#include <Eigen/Geometry>
