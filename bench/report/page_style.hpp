// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

namespace bch::report {

constexpr const char* page_head = R"html(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Bounding cylinder hierarchies: the paper's experiments</title>
<style>
body { margin: 0; background: #fff; color: #1a1a1a; font: 16px/1.5 "Helvetica Neue", Arial, "Liberation Sans", sans-serif; }
main { max-width: 1200px; margin: 0 auto; padding: 24px 20px 64px; }
h1 { font-size: 30px; line-height: 1.2; margin: 16px 0 12px; }
h2 { font-size: 22px; margin: 48px 0 8px; padding-top: 12px; border-top: 2px solid #1a1a1a; }
p, nav, #findings li { max-width: 46em; }
#findings li { margin: 0 0 10px; }
.method { color: #4a4a4a; }
pre { background: #f3f3f3; padding: 10px 14px; overflow-x: auto; }
nav ol { padding-left: 1.6em; columns: 2; }
a { color: #0b5394; }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(520px, 100%), 1fr)); gap: 20px 32px; }
figure { margin: 12px 0; break-inside: avoid; }
figure svg { display: block; width: 100%; height: auto; }
figcaption { color: #4a4a4a; font-size: 14px; }
.wide { overflow-x: auto; margin: 20px 0; }
table { border-collapse: collapse; font-size: 13.5px; line-height: 1.35; }
caption { text-align: left; color: #4a4a4a; font-size: 12.5px; padding-bottom: 4px; }
th { text-align: left; vertical-align: bottom; border-bottom: 1.5px solid #1a1a1a; padding: 3px 14px 3px 0; }
td { border-bottom: 1px solid #ddd; padding: 3px 14px 3px 0; }
th.number { text-align: right; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
@media (max-width: 600px) { body { font-size: 15px; } main { padding: 12px 12px 40px; } h1 { font-size: 24px; }
  nav ol { columns: 1; } td { white-space: nowrap; } }
@media print { main { max-width: none; padding: 0; } nav { display: none; } .wide { overflow: visible; }
  table { font-size: 8.5pt; } h2 { break-after: avoid; } tr { break-inside: avoid; }
  .figures { grid-template-columns: 1fr 1fr; gap: 8px 16px; } }
</style></head>
<body><main>
)html";

constexpr const char* page_introduction =
    R"html(<h1>Bounding cylinder hierarchies: the paper's experiments</h1>
<p>What S. A. Stüvel, N. Magnenat-Thalmann, D. Thalmann, A. Egges and A. F. van der Stappen measured in “Hierarchical
structures for collision checking between virtual characters” (Computer Animation and Virtual Worlds 25, 2014), measured
again, and what they leave open: what does each microsecond buy? Numbers come from the CSV files beside this page. Ranges
are quartiles of times and 95 % confidence intervals of everything else. This makes it again:</p>
)html";

}  // namespace bch::report
