function parameters = read_parameters(results)
  % READ_PARAMETERS  The identified parameters of a run.
  %   p = myoid.read_parameters('results')
  % results: the folder, or its parameters.csv. Returns the table of parameters.csv: a row for each muscle, parameter,
  % method and case, with estimate, ci_low, ci_high (95 %), verdict and reason. In Octave, which has no tables, a
  % struct with a field for each column: numbers as n x 1 (NaN where there is none), texts as cell arrays.
  file = results;
  if exist(results, 'dir')
    file = fullfile(results, 'parameters.csv');
  end
  rows = cells_of(fileread(file));
  parameters = struct();
  texts = {'muscle', 'parameter', 'unit', 'method', 'case', 'verdict', 'reason'};
  flags = {'at_bound', 'routes_disagree'};
  for r = 2:numel(rows)
    if numel(rows{r}) ~= numel(rows{1})
      error('myoid:badInput', '%s: row %d has %d cells, expected %d as in the header', file, r, numel(rows{r}), ...
            numel(rows{1}));
    end
  end
  for c = 1:numel(rows{1})
    name = rows{1}{c};
    column = cellfun(@(row) row{c}, rows(2:end), 'UniformOutput', false)';
    if any(strcmp(name, texts))
      parameters.(field_of(name)) = column;
    elseif any(strcmp(name, flags))
      parameters.(name) = strcmp(column, 'true');
    else
      numbers = str2double(column);
      wrong = find(isnan(numbers) & ~cellfun(@isempty, column) & ~strcmpi(column, 'nan'), 1);
      if ~isempty(wrong)
        error('myoid:badInput', '%s: row %d, column ''%s'': expected a number, found ''%s''', file, wrong + 1, name, ...
              column{wrong});
      end
      parameters.(name) = numbers;
    end
  end
  if ~exist('OCTAVE_VERSION', 'builtin')
    parameters = struct2table(parameters);
  end
end

function name = field_of(name)
  % `case` is a word of the language.
  if strcmp(name, 'case')
    name = 'fit_case';
  end
end

function rows = cells_of(text)
  % The cells of a table with commas; quotes as RFC 4180 has them.
  rows = {};
  row = {};
  cell_text = '';
  quoted = false;
  k = 1;
  while k <= numel(text)
    c = text(k);
    if quoted
      if c == '"' && k < numel(text) && text(k + 1) == '"'
        cell_text(end + 1) = '"'; %#ok<AGROW>
        k = k + 1;
      elseif c == '"'
        quoted = false;
      else
        cell_text(end + 1) = c; %#ok<AGROW>
      end
    elseif c == '"'
      quoted = true;
    elseif c == ','
      row{end + 1} = cell_text; %#ok<AGROW>
      cell_text = '';
    elseif c == char(10)
      row{end + 1} = cell_text; %#ok<AGROW>
      rows{end + 1} = row; %#ok<AGROW>
      row = {};
      cell_text = '';
    elseif c ~= char(13)
      cell_text(end + 1) = c; %#ok<AGROW>
    end
    k = k + 1;
  end
  if ~isempty(row) || ~isempty(cell_text)
    row{end + 1} = cell_text;
    rows{end + 1} = row;
  end
end
