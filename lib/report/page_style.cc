#include "report/page_parts.h"

namespace plumbline::report::page
{
  // Tints of the verdicts are those of Okabe and Ito's green, vermilion and yellow, on which dark
  // text has a contrast of more than 7; words and signs say the same.
  const char *const style_sheet = R"css(
:root { --ink: #1c2126; --soft: #5a646e; --rule: #e2e6ea; --ground: #f7f8f9; --link: #00588a; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1200px; padding: 2.5rem 1.5rem 4rem; color: var(--ink);
  background: #fff; font: 16px/1.55 system-ui, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", sans-serif; }
h1 { font-size: 1.9rem; font-weight: 650; letter-spacing: -.015em; line-height: 1.2; margin: .1rem 0 .4rem; }
h2 { font-size: 1.25rem; font-weight: 650; letter-spacing: -.005em; margin: 3rem 0 .6rem; padding-top: .9rem;
  border-top: 1px solid var(--rule); }
h3 { font-size: 1rem; font-weight: 650; margin: 1.4rem 0 .4rem; }
p { margin: .5rem 0; max-width: 75ch; }
a { color: var(--link); text-decoration: none; }
a:hover { text-decoration: underline; }
code, pre { font-family: ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; font-size: .86em; }
pre { background: var(--ground); border: 1px solid var(--rule); border-radius: 6px; padding: .9rem 1.1rem;
  overflow-x: auto; line-height: 1.45; }
.brand { color: var(--soft); font-size: .82rem; letter-spacing: .09em; text-transform: uppercase; }
.purpose { font-size: 1.12rem; color: #333b43; }
.soft, figcaption { color: var(--soft); font-size: .88rem; }
nav { margin: 1rem 0 0; font-size: .9rem; }
nav a { margin-right: 1.1rem; white-space: nowrap; }
.facts { display: flex; flex-wrap: wrap; gap: .5rem; padding: 0; margin: 1rem 0 0; list-style: none; }
.facts li { border: 1px solid var(--rule); border-radius: 99px; padding: .12rem .8rem; font-size: .88rem; }
.banner, .warning { border-left: 4px solid #D55E00; background: #fdf1ea; padding: .7rem 1rem; margin: 1rem 0;
  border-radius: 0 6px 6px 0; max-width: none; }
.answer { font-size: 1.08rem; max-width: 85ch; }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(430px, 100%), 1fr)); gap: .8rem; margin: .8rem 0; }
.card { background: var(--ground); border: 1px solid var(--rule); border-left: 3px solid #0072B2; border-radius: 6px;
  padding: .7rem .95rem; }
.card h3 { font-size: .86rem; color: var(--soft); font-weight: 600; margin: 0 0 .2rem; }
.card p { margin: .3rem 0 0; }
.card td { padding: .18rem .9rem .18rem 0; white-space: nowrap; max-width: none; }
.card td small { display: block; white-space: normal; }
.card tr:last-child td { border-bottom: 0; }
.card .marker { margin: 0 .35rem; }
.avoid { color: #8a3500; font-size: .9rem; }
.wide { overflow-x: auto; margin: .7rem 0; }
table { border-collapse: collapse; font-size: .875rem; font-variant-numeric: tabular-nums; }
th { text-align: left; font-weight: 600; color: #39424b; border-bottom: 1.5px solid #aab3bb; vertical-align: bottom; }
th, td { padding: .32rem .75rem .32rem 0; }
td { border-bottom: 1px solid var(--rule); vertical-align: top; max-width: 46ch; }
th.n, td.n { text-align: right; white-space: nowrap; }
.wide tr:hover td { background: var(--ground); }
.verdicts { min-width: 24rem; border-collapse: separate; border-spacing: 3px; }
.verdicts th { border: 0; padding: .2rem .5rem; }
.verdicts th.problem { border-bottom: 1.5px solid #aab3bb; }
.verdicts th.method { white-space: nowrap; font-weight: 600; color: var(--ink); vertical-align: middle; }
.verdicts td { border: 0; border-radius: 5px; padding: .34rem .5rem; min-width: 6.2rem; line-height: 1.32; }
.verdicts td b { white-space: nowrap; font-size: .82rem; }
.verdicts td small { display: block; font-size: .78rem; white-space: nowrap; }
.wide .verdicts tr:hover td.converges, td.converges { background: #dff2ea; color: #004a37; }
.wide .verdicts tr:hover td.stalls, td.stalls { background: #fbe5d8; color: #6e2f00; }
.wide .verdicts tr:hover td.undecided, td.undecided { background: #fdf4cc; color: #4f3f00; }
.wide .verdicts tr:hover td.failed, td.failed { background: #e7e9ec; color: #33393f; }
td.absent { background: #fafafa; color: #9aa2aa; }
.marker { vertical-align: -3px; margin-right: .5rem; }
figure { margin: 1rem 0; }
figure svg { width: 100%; height: auto; display: block; }
figure svg text { font-family: system-ui, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", sans-serif; }
figure.large { max-width: 960px; }
.grid { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(480px, 100%), 1fr)); gap: .4rem 1.6rem; }
.grid figure { margin: .4rem 0; }
details { margin: .7rem 0; }
summary { cursor: pointer; color: var(--link); font-weight: 550; padding: .15rem 0; }
.no { color: #a03c00; font-weight: 600; }
.yes { color: #00614a; font-weight: 600; }
footer { margin-top: 3rem; border-top: 1px solid var(--rule); padding-top: .8rem; }
@media (max-width: 640px) { body { padding: 1.2rem .9rem 3rem; } .grid { grid-template-columns: 1fr; } }
@media print {
  @page { margin: 14mm; }
  body { max-width: none; padding: 0; font-size: 10.5pt; }
  nav { display: none; }
  h2, h3 { break-after: avoid; }
  figure, tr, .card { break-inside: avoid; }
  .wide { overflow: visible; }
  td { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  details::details-content { content-visibility: visible; }
}
)css";
} // namespace plumbline::report::page
