// Rendered by the browser alone: React 19 sets the properties of the tag and listens to its events. For a tree that a server renders there is `TouchPath` of touchpath/react.
import { useState } from "react";
import { createRoot } from "react-dom/client";
import type { Job } from "touchpath";
import "touchpath/element";
import type {} from "touchpath/react"; // the types of <touch-path>

function Probing() {
  const [job, setJob] = useState<Job>({ format: 1, name: "FROM_REACT", cycle: { type: "hole", diameter: 30 } });
  const [lines, setLines] = useState(0);
  return (
    <>
      <p role="status">
        {job.name}: diameter {job.cycle.type === "hole" && job.cycle.diameter}, {lines} lines
      </p>
      <button type="button" onClick={() => setJob({ ...job, cycle: { type: "hole", diameter: 44 } })}>
        44 mm
      </button>
      <touch-path
        style={{ height: 640 }}
        job={job}
        theme="light"
        onjob-change={(event) => setJob(event.detail.job)}
        onplan-change={(event) => setLines(event.detail.plan.program.text.split("\n").length - 1)}
      />
    </>
  );
}

createRoot(document.getElementById("root") as HTMLElement).render(<Probing />);
