// A postprocessor's view of a job: the parameters that the CAM system would hand over, and the lines of the program that touch.
//
//     dotnet run -- job.json [touchpath ...]
//
// The job is planned by the command (npx touchpath, or the one that is named), which gives the whole plan as JSON.
using System;
using System.Diagnostics;
using System.Linq;
using Newtonsoft.Json;
using Touchpath;

static class Table
{
    static readonly string Npx = Environment.OSVersion.Platform == PlatformID.Win32NT ? "npx.cmd" : "npx";

    static int Main(string[] args)
    {
        if (args.Length == 0)
        {
            Console.Error.WriteLine("usage: table job.json [touchpath ...]");
            return 2;
        }
        var command = args.Length > 1 ? args.Skip(1).ToArray() : new[] { Npx, "--no-install", "touchpath" };
        var words = command.Skip(1).Concat(new[] { "plan", args[0], "--json" }).Select(word => "\"" + word + "\"");
        var start = new ProcessStartInfo(command[0], string.Join(" ", words))
        {
            RedirectStandardOutput = true,
            RedirectStandardError = true,
            UseShellExecute = false,
        };
        using (var process = Process.Start(start))
        {
            var errors = process.StandardError.ReadToEndAsync();
            var answer = process.StandardOutput.ReadToEnd();
            process.WaitForExit();
            if (process.ExitCode == 0) return Show(JsonConvert.DeserializeObject<Plan>(answer));
            // A job with errors is answered with its findings as JSON, anything else in words.
            if (process.ExitCode == 1)
                foreach (var finding in JsonConvert.DeserializeObject<CheckLine>(errors.Result).Findings)
                    if (finding.Level == "error") Console.Error.WriteLine(args[0] + ": " + finding.Path + ": " + finding.Message);
            if (process.ExitCode != 1) Console.Error.WriteLine(errors.Result.Trim());
            return process.ExitCode;
        }
    }

    static int Show(Plan plan)
    {
        foreach (var row in plan.Table)
            Console.WriteLine("{0,-22} {1,-14} {2}", row.Code, JsonConvert.SerializeObject(row.Value), row.Meaning);
        var lines = plan.Program.Text.TrimEnd('\n').Split('\n');
        Console.WriteLine("\n{0}: {1} lines, {2}", plan.Program.Post, lines.Length, plan.Program.Does);
        for (var i = 0; i < plan.Moves.Length; i++)
        {
            var line = (int)plan.Program.MoveLines[i];
            if (plan.Moves[i].Kind == "touch" && line >= 0)
                Console.WriteLine("touch {0}: line {1}: {2}", plan.Moves[i].Touch + 1, line + 1, lines[line]);
        }
        return 0;
    }
}
