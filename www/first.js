// If nothing is stored and the address holds no job, the page starts with a job whose picture is part of its markup. The picture stays until the page draws its
// own.
(() => {
  try {
    if (location.hash || location.search || sessionStorage.getItem("touchpath.tab.1")) return;
    if (localStorage.getItem("touchpath.job.1")) return;
  } catch {
    // No storage: start with the first job.
  }
  // The answers for it are needed immediately.
  const answers = document.createElement("link");
  answers.rel = "modulepreload";
  answers.href = "./first-answers.js";
  document.head.append(answers);
  document.documentElement.classList.add(/^en-US\b/i.test(navigator.languages[0] ?? "") ? "first-inch" : "first-mm");
})();
