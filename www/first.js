// Where nothing is kept and the address says no job, the page begins with the job whose picture stands in it already: it is seen until the page draws by itself.
(() => {
  try {
    if (location.hash || location.search || sessionStorage.getItem("touchpath.tab.1")) return;
    if (localStorage.getItem("touchpath.job.1")) return;
  } catch {
    // No storage: the first job it is.
  }
  // What the module says of it is needed at once.
  const answers = document.createElement("link");
  answers.rel = "modulepreload";
  answers.href = "./first-answers.js";
  document.head.append(answers);
  document.documentElement.classList.add(/^en-US\b/i.test(navigator.languages[0] ?? "") ? "first-inch" : "first-mm");
})();
