// How the search of this site ranks pages. A word in a title counts most; a page that answers a question comes first.

var Scorer = {
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
  score: ([page, , , , score]) => score + (page.startsWith("how-to/") ? 4 : 0) - (page.startsWith("reference/commands") ? 4 : 0),
};
