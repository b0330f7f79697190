// Vue sets properties of custom elements where they have them (`.job`), and listens to their events. With single-file components, tell the compiler
// that the tag is an element: compilerOptions.isCustomElement = (tag) => tag === "touch-path".
import { createApp, h, ref } from "vue";
import "touchpath-element";

createApp({
  setup() {
    const job = ref({
      format: 1,
      name: "FROM_VUE",
      cycle: { type: "hole", diameter: 30 },
    });
    const lines = ref(0);
    return () => [
      h(
        "p",
        { role: "status" },
        `${job.value.name}: diameter ${job.value.cycle.diameter}, ${lines.value ?? "no"} lines`,
      ),
      h(
        "button",
        {
          onClick: () =>
            (job.value = {
              ...job.value,
              cycle: { ...job.value.cycle, diameter: 44 },
            }),
        },
        "44 mm",
      ),
      h("touch-path", {
        style: { height: "640px" },
        // A plain copy: what Vue watches is a proxy, and no proxy can be copied by structuredClone.
        ".job": JSON.parse(JSON.stringify(job.value)),
        theme: "light",
        onJobChange: (event) => (job.value = event.detail.job),
        // No plan while the job has errors: then there is no program either.
        onPlanChange: ({ detail: { plan } }) =>
          (lines.value = plan && plan.program.text.split("\n").length - 1),
      }),
    ];
  },
}).mount("#root");
