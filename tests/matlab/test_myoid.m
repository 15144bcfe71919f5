function test_myoid(work)
  % Tests of the package myoid with a small virtual person; `work`: an empty folder.
  protocol = fullfile(work, 'p.toml');
  file = fopen(protocol, 'w');
  fprintf(file, ['level = "L1"\n[[trial]]\nname = "mvc"\nkind = "mvc"\ndirection = "both"\n' ...
                 '[[trial]]\nname = "lift"\nkind = "eccentric"\nheld_mass_kg = 1.0\n']);
  fclose(file);
  recording = fullfile(work, 'it''s here');
  myoid.call('twin', {}, 'protocol', protocol, 'out', recording, 'quiet', true);
  warning('off', 'myoid:gateFailed');

  % Ten lines: from a study to a muscle's force, its interval and a series.
  out = fullfile(work, 'results');
  r = myoid.run(fullfile(recording, 'study.toml'), out);
  p = r.parameters;
  k = find(strcmp(p.muscle, 'BIC') & strcmp(p.parameter, 'max_isometric_force') & strcmp(p.method, 'torque'));
  printf('F_max of BIC: %.0f N (%.0f to %.0f), %s\n', p.estimate(k), p.ci_low(k), p.ci_high(k), p.verdict{k});
  lift = r.trials(strcmp({r.trials.name}, 'lift'));
  angle = lift.series.ik;
  elbow = angle.values(:, strcmp(angle.names, 'elbow_flexion'));
  printf('elbow: %.0f to %.0f deg in %.1f s\n', min(elbow), max(elbow), angle.time(end));

  assert(numel(k) == 1);
  assert(p.ci_low(k) < p.estimate(k) && p.estimate(k) < p.ci_high(k));
  lines = sum(fileread(fullfile(out, 'parameters.csv')) == char(10));
  assert(numel(p.estimate), lines - 1);
  assert(isnan(p.prior_mean(strcmp(p.method, 'paper'))(1)), 'an empty cell is NaN');
  assert(any(~cellfun(@isempty, strfind(p.reason, ','))), 'a reason with commas is one cell');
  assert(islogical(p.at_bound));
  assert(iscellstr(p.fit_case));

  assert(angle.in_degrees && strcmp(angle.title, 'Coordinates'));
  assert(max(elbow) > 90 && min(elbow) > -10);
  assert(size(angle.values), [numel(angle.time), numel(angle.names)]);
  forces = lift.series.identified_forces;
  assert(~forces.in_degrees && any(strcmp(forces.names, 'TRI_identified')));
  assert(strcmp(r.run.program, 'myoid'));

  % Names are the user's.
  text = strrep(fileread(fullfile(recording, 'study.toml')), 'name = "lift"', 'name = "slow 2 kg / [x]"');
  handle = fopen(fullfile(recording, 'odd names.toml'), 'w');
  fwrite(handle, text);
  fclose(handle);
  odd = myoid.run(fullfile(recording, 'odd names.toml'), fullfile(work, 'odd'));
  assert(isfield(odd.trials(strcmp({odd.trials.name}, 'slow 2 kg / [x]')).series, 'ik'));

  % The same numbers again by read_results, and by the file itself.
  again = myoid.read_results(out);
  assert(isequaln(again.parameters, p));
  assert(isequaln(myoid.read_parameters(fullfile(out, 'parameters.csv')), p));

  has_the_same_in_one_file(fullfile(recording, 'study.toml'), work);

  % identify, straight from the files of the run.
  muscles = fullfile(work, 'muscles.csv');
  file = fopen(muscles, 'w');
  fprintf(file, ['muscle,emg,max_isometric_force,optimal_fiber_length,force_length_width,' ...
                 'concentric_curvature,eccentric_curvature_product,eccentric_plateau,max_shortening_speed,' ...
                 'tendon_slack_length\n']);
  for row = {'BIC', 'BIC', 1060, 0.1224, 0.055, 1.22, 0.21; 'TRI', 'TRI', 2047, 0.1217, 0.0548, 1.22, 0.2}'
    fprintf(file, '%s,%s,%g,%g,%g,0.28,0.058,1.4,%g,%g\n', row{:});
  end
  fclose(file);
  trial = fullfile(out, 'lift');
  warning('off', 'all');
  q = myoid.identify(fullfile(work, 'identified'), 'muscles', muscles, ...
                     'activations', {fullfile(trial, 'activation.sto')}, ...
                     'lengths', {fullfile(trial, 'MuscleAnalysis_Length.sto')}, ...
                     'velocities', {fullfile(trial, 'MuscleAnalysis_MuscleTendonVelocity.sto')}, ...
                     'moment_arms', {fullfile(trial, 'MuscleAnalysis_MomentArm_elbow_flexion.sto')}, ...
                     'torques', {fullfile(trial, 'id.sto')}, 'coordinate', 'elbow_flexion', 'method', 'torque');
  assert(any(strcmp(q.muscle, 'TRI')));

  reads_what_the_program_reads(work);
  takes_series_and_leaves_empty_values_out(recording, lift.series);
  says_where_a_missing_program_goes();
  refuses_values_it_does_not_understand();

  % Errors map one to one and carry the program's own words.
  fails(@() myoid.run(fullfile(work, 'none.toml'), fullfile(work, 'x')), 'myoid:badInput', 'no such file');
  fails(@() myoid.run(fullfile(recording, 'study.toml'), out, 'no_such_option', 1), 'myoid:commandLine', '');
  fails(@() myoid.read_results(work), 'myoid:badInput', 'run.json');
  disp('matlab/+myoid: all tests passed');
end

function reads_what_the_program_reads(work)
  % The program's reader: numbers, gaps of a header, and the line of a row of another length.
  head = ['Coordinates' char(10) 'version=1' char(10) 'inDegrees=yes' char(10) 'endheader' char(10)];
  labels = ['time' char(9) 'a' char(9) 'b' char(10)];
  file = fullfile(work, 'rows.sto');
  write_text(file, [head labels sprintf('0\t1\t2\n0.5\t3\t0.1\n\n1\t-5e-3\t6\n')]);
  d = myoid.read_sto(file);
  assert(isequal(d.names, {'a', 'b'}) && isequal(d.time, [0; 0.5; 1]) && d.in_degrees);
  assert(isequal(d.values, [1 2; 3 0.1; -5e-3 6]) && strcmp(d.title, 'Coordinates'));
  for body = {sprintf('0\t1\t2\n0.5\t3\n1\t4\t5\t6\n'), sprintf('0\t1\t2\n0.5\tx\t4\n'), ...
              sprintf('0\t1\t2\n0.5\t1,5\t2\n')}
    write_text(file, [head labels body{1}]);
    fails(@() myoid.read_sto(file), 'myoid:badInput', 'rows.sto:');
  end
  fails(@() myoid.read_sto(fullfile(work, 'none.sto')), 'myoid:badInput', 'none.sto');
  parameters = fullfile(work, 'parameters.csv');
  write_text(parameters, ['muscle,estimate' char([13 10]) '"say ""x"", y",1' char([13 10]) '"",2' char(10) ...
                          repmat('n', 1, 1e5) ',3' char(10)]);
  p = myoid.read_parameters(parameters);
  assert(isequal(p.muscle, {'say "x", y'; ''; repmat('n', 1, 1e5)}));
  assert(isequal(p.estimate, [1; 2; 3]));
end

function takes_series_and_leaves_empty_values_out(recording, lift)
  % A series in place of a file gives the same numbers; empty values and false are not given.
  model = fullfile(recording, 'model.osim');
  one = [tempname() '.sto'];
  two = [tempname() '.sto'];
  tidy = onCleanup(@() cellfun(@delete, {one, two}));
  myoid.call('id', {}, 'model', model, 'motion', lift.ik, 'out', one, 'lowpass', 6, 'quiet', true);
  other = lift.ik;
  other.values = lift.ik.values * pi / 180;
  other.in_degrees = false;
  myoid.call('id', {}, 'model', model, 'motion', {other}, 'out', two, 'lowpass', 6, 'quiet', true, 'loads', '', ...
             'held_mass', [], 'speeds', {}, 'overwrite', false);
  first = myoid.read_sto(one);
  second = myoid.read_sto(two);
  assert(max(abs(first.values(:) - second.values(:))) < 1e-6);
  if exist('OCTAVE_VERSION', 'builtin')  % has no class table; @table stands for it
    columns = cell2struct([{other.time}, num2cell(other.values, 1)], [{'time'}, other.names(:)'], 2);
    myoid.call('id', {}, 'model', model, 'motion', table(columns), 'out', two, 'lowpass', 6, 'quiet', true, ...
               'overwrite', true);
    third = myoid.read_sto(two);
    assert(isequal(third.values, second.values) && isequal(third.names, second.names));
  end
  % A logical vector chooses samples, as in any array.
  half = other.time < mean(other.time);
  other.values = other.values(half, :);
  other.time = other.time(half);
  myoid.call('id', {}, 'model', model, 'motion', other, 'out', two, 'lowpass', 6, 'quiet', true, 'overwrite', true);
  fourth = myoid.read_sto(two);
  assert(numel(fourth.time) == sum(half));
end

function says_where_a_missing_program_goes()
  place = getenv('MYOID');
  setenv('MYOID', '/no/such/myoid');
  back = onCleanup(@() setenv('MYOID', place));
  fails(@() myoid.call('info', {}), 'myoid:noProgram', 'MYOID');
end

function refuses_values_it_does_not_understand()
  % [1 2] is two words, not 12: --threads takes one, and the other is a file that is not there.
  fails(@() myoid.call('info', {}, 'threads', [1 2]), 'myoid:badInput', '2: there is no such file');
  fails(@() myoid.call('info', {'no "such" ''file'' $HOME `x` \ %d.c3d'}), 'myoid:badInput', ...
        'no "such" ''file'' $HOME `x` \ %d.c3d');
  for value = {struct('a', 1), 1 + 2i, {[1 2]}, @sin, ['ab'; 'cd'], [true false]}
    fails(@() myoid.call('info', {}, 'threads', value{1}), 'myoid:commandLine', 'option threads');
  end
  fails(@() myoid.call('info', {}, 'threads'), 'myoid:commandLine', 'pairs');
  fails(@() myoid.call('info', {}, 3, 4), 'myoid:commandLine', 'name of an option');
end

function write_text(file, text)
  f = fopen(file, 'w');
  fwrite(f, text);
  fclose(f);
end

function has_the_same_in_one_file(study, work)
  % --mat FILE has what read_results reads from the folder: every number to the bit, every text.
  out = fullfile(work, 'with mat');
  file = fullfile(work, 'results.mat');
  try
    r = myoid.run(study, out, 'mat', file);
  catch problem
    assert(~isempty(strfind(problem.message, 'libmatio')), problem.message);
    disp('skipped: there is no libmatio');
    return
  end
  m = load(file);
  assert(isequaln(m.parameters, r.parameters));
  assert(numel(m.trials) == numel(r.trials) && numel(r.trials) == 2);
  for k = 1:numel(r.trials)
    assert(strcmp(m.trials(k).name, r.trials(k).name) && strcmp(m.trials(k).use, r.trials(k).use));
    names = fieldnames(r.trials(k).series);
    assert(isequal(sort(names), sort(fieldnames(m.trials(k).series))) && numel(names) >= 3);
    for j = 1:numel(names)
      found = m.trials(k).series.(names{j});
      wanted = r.trials(k).series.(names{j});
      assert(isequal(found.names, wanted.names) && isequal(found.title, wanted.title));
      assert(isequaln(found.time, wanted.time) && isequaln(found.values, wanted.values), names{j});
      assert(islogical(found.in_degrees) && found.in_degrees == wanted.in_degrees);
      assert(numel(found.units) == numel(found.names) && ~any(cellfun(@isempty, found.units)));
    end
  end
  lift = m.trials(strcmp({m.trials.name}, 'lift')).series;
  assert(strcmp(lift.ik.units{1}, 'deg') && strcmp(lift.id.units{1}, 'N m'));
  table = dlmread(fullfile(out, 'posterior.csv'), ',', 1, 0);
  assert(isequal(table, [m.draws.weights, m.draws.values]));
  assert(strcmp(m.draws.units{strcmp(m.draws.names, 'BIC.max_isometric_force')}, 'N'));
  assert(numel(m.remarks.text) == numel(m.remarks.trial) && strcmp(m.run.version, r.run.version));
  fails(@() myoid.run(study, fullfile(work, 'x'), 'mat', file), 'myoid:badInput', 'results.mat');
  fails(@() myoid.run(study, fullfile(work, 'x'), 'mat', 'r.txt'), 'myoid:badInput', 'ends in .mat');
end

function fails(action, identifier, words)
  try
    action();
  catch problem
    assert(strcmp(problem.identifier, identifier), [problem.identifier ': ' problem.message]);
    assert(isempty(words) || ~isempty(strfind(problem.message, words)), problem.message);
    return
  end
  error('no error where %s was expected', identifier);
end
