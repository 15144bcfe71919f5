function results = read_results(folder)
  % READ_RESULTS  All results of a run.
  %   r = myoid.read_results('results')
  % r.folder; r.parameters: read_parameters; r.run: run.json (versions, inputs, stages, trials); r.trials: a struct
  % array with name, use, failure and the series that the run wrote (ik, id, activation, identified_forces,
  % StaticOptimization_force, ...), each as read_sto returns them; empty where there is none.
  if ~exist(fullfile(folder, 'run.json'), 'file')
    error('myoid:badInput', '%s holds no run.json; give the folder of a finished run', folder);
  end
  results.folder = folder;
  results.parameters = myoid.read_parameters(folder);
  results.run = jsondecode(fileread(fullfile(folder, 'run.json')));
  trials = results.run.trials;
  results.trials = struct('name', {}, 'use', {}, 'failure', {}, 'series', {});
  for k = 1:numel(trials)
    if iscell(trials)
      trial = trials{k};
    else
      trial = trials(k);
    end
    place = fullfile(folder, trial.folder);
    series = struct();
    files = [dir(fullfile(place, '*.sto')); dir(fullfile(place, '*.mot'))];
    for j = 1:numel(files)
      [~, name] = fileparts(files(j).name);
      series.(regexprep(name, '\W', '_')) = myoid.read_sto(fullfile(place, files(j).name));
    end
    results.trials(k) = struct('name', trial.name, 'use', trial.use, 'failure', trial.failure, 'series', series);
  end
end
